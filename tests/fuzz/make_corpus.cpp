// SPDX-License-Identifier: BSD-3-Clause
// make_corpus FOLDER SOURCE: writes good and nearly good files of each format to FOLDER/<format>, as seeds for the
// fuzzers. SOURCE is the project's folder.
#include <algorithm>
#include <bit>
#include <iostream>
#include <nlohmann/json.hpp>

#include "corpus.h"

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using toposcope::fuzz::Corpus;

template <class T>
std::string bytes(std::initializer_list<T> values, std::endian order = std::endian::little) {
  std::string result;
  for (T value : values) {
    std::string one(reinterpret_cast<const char*>(&value), sizeof value);
    if (order != std::endian::native) std::reverse(one.begin(), one.end());
    result += one;
  }
  return result;
}

const std::string corners = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n0.5 .5 1e0\n";
const std::string faces = "3 0 1 4\n3 1 2 4\n3 2 3 4\n3 3 0 4\n4 3 2 1 0\n5 0 1 2 3 4\n";

void add_ply(Corpus corpus) {
  const auto header = [](const std::string& format, const std::string& index, const std::string& real) {
    return "ply\nformat " + format + " 1.0\ncomment x\nobj_info y\nelement vertex 5\nproperty " + real +
           " x\nproperty " + real + " y\nproperty " + real + " z\nelement face 2\nproperty list uchar " + index +
           " vertex_indices\nend_header\n";
  };
  std::string with_more = header("ascii", "int", "float");
  with_more.replace(with_more.find("face 2"), 6, "face 6");
  corpus.add(with_more + corners + faces);
  for (std::endian order : {std::endian::little, std::endian::big}) {
    const std::string format = order == std::endian::little ? "binary_little_endian" : "binary_big_endian";
    const auto points = bytes<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1}, order);
    corpus.add(header(format, "int", "float") + points + '\3' + bytes<std::int32_t>({0, 1, 4}, order) + '\4' +
               bytes<std::int32_t>({3, 2, 1, 0}, order));
    corpus.add(header(format, "uint", "double") + bytes<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1}, order) +
               '\3' + bytes<std::uint32_t>({0, 1, 4}, order) + '\3' + bytes<std::uint32_t>({2, 1, 0}, order));
    corpus.add("ply\nformat " + format +
               " 1.0\nelement camera 1\nproperty list int short m\nelement vertex 5\nproperty float x\nproperty float "
               "y\nproperty float z\nproperty uchar red\nelement tristrips 1\nproperty list int int "
               "vertex_indices\nend_header\n" +
               bytes<std::int32_t>({1}, order) + bytes<std::int16_t>({7}, order) + bytes<float>({0, 0, 0}, order) +
               'r' + bytes<float>({1, 0, 0}, order) + 'g' + bytes<float>({1, 1, 0}, order) + 'b' +
               bytes<float>({0, 1, 0}, order) + 'a' + bytes<float>({0, 0, 1}, order) + 'x' +
               bytes<std::int32_t>({8, 0, 1, 2, 3, -1, 4, 1, 0}, order));
  }
}

void add_obj(Corpus corpus) {
  corpus.add(
      "# cube\nmtllib a.mtl\no part\nv 0 0 0\nv 1 0 0 1.0\nv 1 1 0 0.5 0.5 0.5\nv 0 1 -0\nvt 0 0\nvn 0 0 1\ng a\n"
      "usemtl b\ns 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\nf -4 -3 \\\n -2 -1\n");
  corpus.add("f 1 2 3 4 5 6\nV 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 1 1 0\nv 0 4 0\nl 1 2\np 1\n");
}

void add_stl(Corpus corpus) {
  std::string text;
  for (const char* facet :
       {"vertex 0 0 0\nvertex 1 0 0\nvertex 1 1 0\n", "vertex 0 0 0\nVERTEX 1 1 0\nvertex 0 1e0 -1\n"})
    text += "facet normal 0 0 1\n outer loop\n" + std::string(facet) + " endloop\nendfacet\n";
  corpus.add("solid a\n" + text + "endsolid a\nSOLID b\n" + text + "ENDSOLID b\n");
  for (std::uint32_t count : {2U, 0U, 3U}) {
    std::string header = count == 2 ? "solid binary" : "COLOR=rgba,MATERIAL=aaaa";
    header.resize(80, ' ');
    corpus.add(header + bytes<std::uint32_t>({count}) + bytes<float>({0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0}) + "ab" +
               bytes<float>({0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, -0.F}) + "cd");
  }
}

void add_off(Corpus corpus) {
  corpus.add("OFF\n5 6 0\n" + corners + faces);
  corpus.add("# c\nOFF5 6 11 # d\n" + corners + "#\n" + faces);
  corpus.add("COFF\n4 1 0\n0 0 0 1 0 0 1\n1 0 0 255 0 0 255\n1 1 0 0 0 0\n0 1 0 0\n4 0 1 2 3 255 0 0\n");
  corpus.add("STCNOFF BINARY\n" + bytes<std::int32_t>({3, 1, 0}, std::endian::big) +
             bytes<float>({0, 0, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 1,
                           1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0, 0},
                          std::endian::big) +
             bytes<std::int32_t>({3, 0, 1, 2, 0}, std::endian::big));
  corpus.add("OFF BINARY\n" + bytes<std::int32_t>({4, 2, 0}, std::endian::big) +
             bytes<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, std::endian::big) +
             bytes<std::int32_t>({3, 0, 1, 2, 0, 4, 0, 1, 2, 3, 1, 7}, std::endian::big));
}

std::string glb(std::string json, const std::string& binary) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const auto length = [](std::size_t size) { return bytes<std::uint32_t>({static_cast<std::uint32_t>(size)}); };
  return "glTF" + length(2) + length(28 + json.size() + binary.size()) + length(json.size()) + "JSON" + json +
         length(binary.size()) + std::string("BIN\0", 4) + binary;
}

void add_gltf(Corpus corpus) {
  const std::string binary = bytes<float>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}) +
                             bytes<std::uint16_t>({0, 1, 2, 0, 2, 3}) + bytes<std::uint8_t>({0, 1, 3, 2});
  Json json = Json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}],
    "nodes": [{"children": [2], "matrix": [1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}, {"mesh": 0, "scale": [-1,1,1]},
              {"mesh": 1, "translation": [0,0,1], "rotation": [0,0,0,1]}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]},
               {"primitives": [{"attributes": {"POSITION": 0}, "indices": 2, "mode": 5},
                               {"attributes": {"POSITION": 3}, "mode": 6}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3"},
                  {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"},
                  {"bufferView": 2, "byteOffset": 12, "componentType": 5121, "count": 4, "type": "SCALAR"},
                  {"componentType": 5126, "count": 4, "type": "VEC3",
                   "sparse": {"count": 2, "indices": {"bufferView": 2, "byteOffset": 13, "componentType": 5121},
                              "values": {"bufferView": 0, "byteOffset": 12}}}],
    "bufferViews": [{"buffer": 0, "byteLength": 48, "byteStride": 12}, {"buffer": 0, "byteOffset": 48, "byteLength": 12},
                    {"buffer": 0, "byteOffset": 48, "byteLength": 16}],
    "buffers": [{"byteLength": 64}]})");
  corpus.add(glb(json.dump(), binary));
  Json quantised = json;
  quantised["accessors"][0] = {
      {"bufferView", 2}, {"componentType", 5121}, {"count", 4}, {"type", "VEC3"}, {"normalized", true}};
  corpus.add(glb(quantised.dump(), binary));
  json["meshes"].erase(1);
  json["nodes"].erase(2);
  json["nodes"][0] = {{"mesh", 0}};
  json["buffers"][0] = {{"byteLength", 64}, {"uri", "none/a%20b.bin"}};
  corpus.add(json.dump());
  json["buffers"][0]["uri"] =
      "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAACAPwAAgD8AAAAAAAAAAAAA"
      "gD8AAAAAAAABAAIAAAACAAMAAAEDAg==";
  corpus.add(json.dump(1));
  json.erase("scenes");
  corpus.add(json.dump());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::cerr << "usage: make_corpus FOLDER SOURCE\n";
    return 2;
  }
  const fs::path folder = argv[1];
  add_ply(Corpus(folder / "ply"));
  add_obj(Corpus(folder / "obj"));
  add_stl(Corpus(folder / "stl"));
  add_off(Corpus(folder / "off"));
  add_gltf(Corpus(folder / "gltf"));
  toposcope::fuzz::add_documents(folder, argv[2]);
}
