// SPDX-License-Identifier: BSD-3-Clause
#include "formats/json_place.h"

#include "base/json_text.h"

namespace toposcope {
namespace {

class Walk {
 public:
  explicit Walk(std::string_view text) : text_(text) {}

  std::size_t follow(const std::vector<JsonStep>& path) {
    skip_space();
    for (const JsonStep& step : path)
      if (!enter(step)) break;
    return at_;
  }

 private:
  char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void skip_space() {
    while (now() == ' ' || now() == '\t' || now() == '\n' || now() == '\r') ++at_;
  }

  // To the value of a key or index, or back to the value that has none.
  bool enter(const JsonStep& step) {
    const std::size_t begin = at_;
    const bool object = now() == '{';
    if (!object && now() != '[') return false;
    ++at_;
    skip_space();
    for (std::size_t index = 0; now() != '}' && now() != ']' && now() != '\0'; ++index) {
      std::string_view key;
      if (object) {
        const std::size_t first = at_ + 1;
        skip_string();
        key = text_.substr(first, at_ - first - 1);
        skip_space();
        ++at_;  // the colon
        skip_space();
      }
      if (object ? key == step.key : index == step.index) return true;
      skip_value();
      skip_space();
      if (now() == ',') ++at_;
      skip_space();
    }
    at_ = begin;
    return false;
  }

  void skip_string() {
    for (++at_; now() != '"' && now() != '\0'; ++at_)
      if (now() == '\\') ++at_;
    ++at_;
  }

  void skip_value() {
    int depth = 0;
    do {
      if (now() == '"') {
        skip_string();
        continue;
      }
      if (now() == '{' || now() == '[') ++depth;
      if (now() == '}' || now() == ']') --depth;
      ++at_;
    } while (at_ < text_.size() && (depth > 0 || !ends()));
  }
  bool ends() const { return now() == ',' || now() == '}' || now() == ']'; }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

std::string json_place(std::string_view text, const std::vector<JsonStep>& path) {
  return line_and_column(text, Walk(text).follow(path));
}

}  // namespace toposcope
