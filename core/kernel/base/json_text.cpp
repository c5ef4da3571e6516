// SPDX-License-Identifier: BSD-3-Clause
#include "base/json_text.h"

#include <algorithm>

#include "base/errors.h"
#include "base/printable.h"

namespace toposcope {
namespace {

constexpr std::size_t deepest_json = 500;
constexpr std::size_t longest_fault = 160;

/// Where the text nests too deep; npos: nowhere.
std::size_t too_deep_at(std::string_view text) {
  std::size_t depth = 0;
  bool quoted = false;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') quoted = !quoted;
    if (quoted) {
      at += c == '\\';
    } else if (c == '[' || c == '{') {
      if (++depth > deepest_json) return at;
    } else if ((c == ']' || c == '}') && depth > 0) {
      --depth;
    }
  }
  return text.npos;
}

/// Looks for the place of an error alone: an exception of a number out of range does not know it.
struct FaultPlace : nlohmann::json_sax<nlohmann::json> {
  std::size_t at = 0;

  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(std::int64_t) override { return true; }
  bool number_unsigned(std::uint64_t) override { return true; }
  bool number_float(double, const std::string&) override { return true; }
  bool string(std::string&) override { return true; }
  bool binary(nlohmann::json::binary_t&) override { return true; }
  bool start_object(std::size_t) override { return true; }
  bool key(std::string&) override { return true; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception&) override {
    at = position == 0 ? 0 : position - 1;
    return false;
  }
};

}  // namespace

std::string line_and_column(std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, std::min(at, text.size()));
  const std::size_t last = before.rfind('\n');
  return std::to_string(1 + std::count(before.begin(), before.end(), '\n')) + ":" +
         std::to_string(before.size() - (last == before.npos ? 0 : last + 1) + 1);
}

std::string json_fault(const nlohmann::json::exception& error) {
  std::string what = error.what();
  if (what.starts_with('['))
    if (const std::size_t end = what.find("] "); end != what.npos) what.erase(0, end + 2);
  if (const std::size_t place = what.find("column "); what.starts_with("parse error at") && place != what.npos)
    if (const std::size_t end = what.find(": ", place); end != what.npos) what.erase(0, end + 2);
  // All that was read of a long value stands there, before what was expected.
  const std::size_t read = what.find("; last read: "), expected = what.rfind("; expected ");
  if (read != what.npos && what.size() > longest_fault)
    what.replace(read, expected != what.npos && expected > read ? expected - read : what.npos, "");
  if (what.size() > longest_fault) what = what.substr(0, longest_fault) + "...";
  return printable(what);
}

template <class Json>
Json parse_json(std::string_view text, const std::string& owner) {
  const auto refuse = [&](std::size_t at, const std::string& what) {
    return UsageError(owner + ":" + line_and_column(text, at) + ": " + what);
  };
  if (const std::size_t at = too_deep_at(text); at != text.npos)
    throw refuse(at, "lists and objects are nested more than " + std::to_string(deepest_json) +
                         " deep; no file of toposcope needs so many: it is damaged");
  try {
    return Json::parse(text);
  } catch (const nlohmann::json::exception& error) {
    FaultPlace place;
    nlohmann::json::sax_parse(text, &place);
    const bool range = dynamic_cast<const nlohmann::json::out_of_range*>(&error) != nullptr;
    throw refuse(place.at, range ? json_fault(error) + "; numbers are at most about 1.8e308"
                                 : "is no JSON: " + json_fault(error));
  }
}

template nlohmann::json parse_json(std::string_view, const std::string&);
template nlohmann::ordered_json parse_json(std::string_view, const std::string&);

}  // namespace toposcope
