// SPDX-License-Identifier: BSD-3-Clause
#include "base/errors.h"
#include "base/json_text.h"
#include "base/text_file.h"
#include "lock/run_lock.h"

namespace toposcope {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* schema_id = "toposcope.lock/1";

Json to_json(const LockedFile& file) {
  return {{"path", file.path}, {"sha256", file.sha256}};
}

Json to_json(const std::vector<LockedFile>& files) {
  Json list = Json::array();
  for (const LockedFile& file : files) list.push_back(to_json(file));
  return list;
}

LockedFile file_of(const Json& json) {
  return {json.at("path"), json.at("sha256")};
}

std::vector<LockedFile> files_of(const Json& json) {
  std::vector<LockedFile> files;
  for (const Json& each : json) files.push_back(file_of(each));
  return files;
}

std::map<std::string, std::string> texts_of(const Json& json) {
  std::map<std::string, std::string> texts;
  for (const auto& entry : json.items()) texts[entry.key()] = entry.value().get<std::string>();
  return texts;
}

RunLock lock_of(const Json& json) {
  RunLock lock;
  lock.program = {json.at("program").at("version"), file_of(json.at("program").at("file"))};
  lock.seed = json.at("seed");
  lock.pipeline = json.at("pipeline");
  if (json.contains("resolution")) lock.resolution = texts_of(json["resolution"]);  // older ones do not
  lock.probability = texts_of(json.at("probability"));
  lock.model = file_of(json.at("model"));
  for (const Json& each : json.at("plugins"))
    lock.plugins.push_back({each.at("kind"), each.at("id"), each.at("version"), file_of(each.at("library")),
                            texts_of(each.at("options")), files_of(each.at("programs"))});
  for (const Json& each : json.at("meshes"))
    lock.meshes.push_back({file_of(each.at("file")), files_of(each.at("parts"))});
  return lock;
}

}  // namespace

std::string to_json(const RunLock& lock) {
  Json plugins = Json::array(), meshes = Json::array();
  for (const LockedPlugin& plugin : lock.plugins)
    plugins.push_back({{"kind", plugin.kind},
                       {"id", plugin.id},
                       {"version", plugin.version},
                       {"library", to_json(plugin.library)},
                       {"options", Json(plugin.options)},
                       {"programs", to_json(plugin.programs)}});
  for (const LockedMesh& mesh : lock.meshes)
    meshes.push_back({{"file", to_json(mesh.file)}, {"parts", to_json(mesh.parts)}});
  const Json json = {{"schema", schema_id},
                     {"program", {{"version", lock.program.version}, {"file", to_json(lock.program.file)}}},
                     {"seed", lock.seed},
                     {"pipeline", lock.pipeline},
                     {"resolution", Json(lock.resolution)},
                     {"probability", Json(lock.probability)},
                     {"model", to_json(lock.model)},
                     {"plugins", plugins},
                     {"meshes", meshes}};
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

RunLock read_lock(const std::filesystem::path& file) {
  try {
    const Json json = parse_json<Json>(read_text_file(file, "lock file"), file.string());
    if (json.at("schema") != schema_id)
      throw UsageError(file.string() + ": schema: must be '" + schema_id + "'; write the lock again with --lock");
    return lock_of(json);
  } catch (const nlohmann::json::exception& error) {
    throw UsageError(file.string() + ": is no lock file (" + json_fault(error) + "); write it again with --lock");
  }
}

}  // namespace toposcope
