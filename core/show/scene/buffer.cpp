// SPDX-License-Identifier: BSD-3-Clause
#include "scene/buffer.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace toposcope {
namespace {

static_assert(std::endian::native == std::endian::little, "buffers are written as they lie in memory");

constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
constexpr double steps = 65535;
constexpr double largest_coordinate = 1e100;  // meshes end before, and squares stay numbers

template <class Value>
SceneJson buffer_of(const char* type, const std::vector<Value>& values) {
  SceneJson buffer = {{"type", type}, {"count", values.size()}};
  buffer["data"] = to_base64({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value)});
  return buffer;
}

template <class Value>
std::vector<Value> values_of(const SceneJson& buffer) {
  const std::string bytes = from_base64(buffer.at("data").get_ref<const std::string&>());
  const auto count = buffer.at("count").get<std::size_t>();
  if (bytes.size() % sizeof(Value) != 0 || bytes.size() / sizeof(Value) != count)
    throw std::invalid_argument("a buffer holds " + std::to_string(bytes.size()) + " bytes and says that it has " +
                                std::to_string(count) + " numbers");
  std::vector<Value> values(count);
  if (count > 0) std::memcpy(values.data(), bytes.data(), bytes.size());
  return values;
}

std::string type_of(const SceneJson& buffer) {
  return buffer.at("type").get<std::string>();
}

[[noreturn]] void refuse(const SceneJson& buffer) {
  throw std::invalid_argument("a buffer of type '" + type_of(buffer) + "' stands where another type is needed");
}

Vec3 triple(const SceneJson& list) {
  return {list.at(0).get<double>(), list.at(1).get<double>(), list.at(2).get<double>()};
}

}  // namespace

std::string to_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : std::uint32_t{0});
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? digits[group >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string from_base64(std::string_view text) {
  std::array<std::int8_t, 256> value;
  value.fill(-1);
  for (std::size_t i = 0; i < digits.size(); ++i)
    value[static_cast<std::uint8_t>(digits[i])] = static_cast<std::int8_t>(i);
  if (text.size() % 4 != 0) throw std::invalid_argument("base64 comes in groups of four characters");
  while (!text.empty() && text.back() == '=') text.remove_suffix(1);
  std::string bytes;
  bytes.reserve(text.size() * 3 / 4);
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::int8_t digit = value[static_cast<std::uint8_t>(c)];
    if (digit < 0) throw std::invalid_argument("base64 holds a character that it does not have");
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  return bytes;
}

SceneJson index_buffer(std::span<const Index> values) {
  if (std::all_of(values.begin(), values.end(), [](Index v) { return v <= 0xffff; })) {
    std::vector<std::uint16_t> small(values.size());
    std::transform(values.begin(), values.end(), small.begin(), [](Index v) { return static_cast<std::uint16_t>(v); });
    return buffer_of("u16", small);
  }
  return buffer_of("u32", std::vector<Index>(values.begin(), values.end()));
}

SceneJson index_buffer(std::span<const Triangle> triangles) {
  std::vector<Index> corners;
  corners.reserve(3 * triangles.size());
  for (const Triangle& triangle : triangles) corners.insert(corners.end(), triangle.begin(), triangle.end());
  return index_buffer(corners);
}

SceneJson byte_buffer(std::span<const std::uint8_t> values) {
  return buffer_of("u8", std::vector<std::uint8_t>(values.begin(), values.end()));
}

SceneJson point_buffer(std::span<const Vec3> points) {
  std::vector<float> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (const double x : p) values.push_back(static_cast<float>(x));
  return buffer_of("f32", values);
}

SceneJson quantised_buffer(std::span<const Vec3> points) {
  Vec3 low = points.empty() ? Vec3(Vec3::Zero()) : points.front(), high = low;
  for (const Vec3& p : points) low = low.cwiseMin(p), high = high.cwiseMax(p);
  const Vec3 step = (high - low) / steps;
  std::vector<std::uint16_t> values;
  values.reserve(3 * points.size());
  for (const Vec3& p : points)
    for (Eigen::Index k = 0; k < 3; ++k)
      values.push_back(
          static_cast<std::uint16_t>(step[k] > 0 ? std::clamp(std::round((p[k] - low[k]) / step[k]), 0.0, steps) : 0));
  SceneJson buffer = buffer_of("q16", values);
  buffer["min"] = {low.x(), low.y(), low.z()};
  buffer["step"] = {step.x(), step.y(), step.z()};
  return buffer;
}

std::vector<Index> read_indices(const SceneJson& buffer) {
  const std::string type = type_of(buffer);
  if (type == "u32") return values_of<Index>(buffer);
  std::vector<Index> values;
  if (type == "u16") {
    for (const std::uint16_t v : values_of<std::uint16_t>(buffer)) values.push_back(v);
  } else if (type == "u8") {
    for (const std::uint8_t v : values_of<std::uint8_t>(buffer)) values.push_back(v);
  } else {
    refuse(buffer);
  }
  return values;
}

std::vector<Triangle> read_triangles(const SceneJson& buffer) {
  const std::vector<Index> corners = read_indices(buffer);
  if (corners.size() % 3 != 0) throw std::invalid_argument("a buffer of triangles ends within a triangle");
  std::vector<Triangle> triangles(corners.size() / 3);
  for (std::size_t i = 0; i < corners.size(); ++i) triangles[i / 3][i % 3] = corners[i];
  return triangles;
}

std::vector<Vec3> read_points(const SceneJson& buffer) {
  const std::string type = type_of(buffer);
  std::vector<double> values;
  if (type == "f32") {
    for (const float v : values_of<float>(buffer)) values.push_back(static_cast<double>(v));
  } else if (type == "q16") {
    const Vec3 low = triple(buffer.at("min")), step = triple(buffer.at("step"));
    for (const std::uint16_t v : values_of<std::uint16_t>(buffer)) {
      const auto k = static_cast<Eigen::Index>(values.size() % 3);
      values.push_back(low[k] + step[k] * v);
    }
  } else {
    refuse(buffer);
  }
  if (values.size() % 3 != 0) throw std::invalid_argument("a buffer of points ends within a point");
  std::vector<Vec3> points;
  points.reserve(values.size() / 3);
  for (std::size_t i = 0; i < values.size(); i += 3) {
    points.emplace_back(&values[i]);
    if (!(points.back().cwiseAbs().maxCoeff() < largest_coordinate) || points.back().hasNaN())
      throw std::invalid_argument("a buffer holds a point that is not finite, or out of reach");
  }
  return points;
}

}  // namespace toposcope
