// SPDX-License-Identifier: BSD-3-Clause
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <map>
#include <sstream>

#include "base/errors.h"
#include "learn/learn.h"

namespace toposcope {
namespace {

/// A change of one line; columns from 0.
struct Edit {
  std::size_t column = 0, length = 0;
  std::string text;
  bool operator<(const Edit& other) const { return column < other.column; }
};

class LessonWriter {
 public:
  LessonWriter(const std::string& text, const std::string& file) : file_(file), root_(YAML::Load(text)) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) lines_.push_back(line);
  }

  void add(const Lesson& lesson) {
    YAML::Node node = root_;
    for (std::size_t i = 0; i + 1 < lesson.path.size(); ++i) node.reset(node[lesson.path[i]]);
    const YAML::Node value = node[lesson.path.back()];
    if (value)
      replace(value, lesson.value);
    else
      insert(node, lesson.path.back() + ": " + lesson.value);
  }

  std::string text(const std::string& source) const {
    std::string all;
    for (std::size_t i = 0; i < lines_.size(); ++i) {
      if (const auto before = new_lines_.find(i); before != new_lines_.end())
        for (const std::string& line : before->second) all += line + "  # " + source + "\n";
      std::string line = lines_[i];
      const auto edits = edits_.find(i);
      if (edits != edits_.end()) {
        std::vector<Edit> sorted = edits->second;
        std::sort(sorted.begin(), sorted.end());
        for (auto edit = sorted.rbegin(); edit != sorted.rend(); ++edit)
          line.replace(edit->column, edit->length, edit->text);
        if (line.find(source) == line.npos) line += (line.find(" #") == line.npos ? "  # " : "; ") + source;
      }
      all += line + "\n";
    }
    return all;
  }

 private:
  void replace(const YAML::Node& value, const std::string& text) {
    const auto line = static_cast<std::size_t>(value.Mark().line),
               column = static_cast<std::size_t>(value.Mark().column);
    // As it is written: in quotes it is longer than it reads.
    std::size_t length = value.Scalar().size();
    const char first = lines_[line][column];
    if (first == '"' || first == '\'') length = lines_[line].find(first, column + 1) + 1 - column;
    if (lines_[line].compare(column, length, value.Scalar()) != 0 && first != '"' && first != '\'')
      throw UsageError(file_ + ":" + std::to_string(line + 1) + ":" + std::to_string(column + 1) +
                       ": the value goes over several lines; write it on one, so that another can take its place");
    set({column, length, text}, line);
  }

  /// Before the first key of the mapping, as it is written.
  void insert(const YAML::Node& mapping, const std::string& text) {
    const auto line = static_cast<std::size_t>(mapping.Mark().line);
    const auto column = static_cast<std::size_t>(mapping.Mark().column);
    if (lines_[line][column] == '{')
      set({column + 1, 0, text + ", "}, line);
    else
      new_lines_[line].push_back(std::string(column, ' ') + text);
  }

  /// Merge keys may lead to one place from several features: the first one has it.
  void set(Edit edit, std::size_t line) {
    std::vector<Edit>& edits = edits_[line];
    const bool taken = std::any_of(edits.begin(), edits.end(), [&](const Edit& each) {
      return each.column == edit.column && each.length > 0 && edit.length > 0;
    });
    if (!taken) edits.push_back(std::move(edit));
  }

  const std::string& file_;
  YAML::Node root_;
  std::vector<std::string> lines_;
  std::map<std::size_t, std::vector<Edit>> edits_;
  std::map<std::size_t, std::vector<std::string>> new_lines_;
};

}  // namespace

std::string with_lessons(const std::string& text, const std::string& file, const std::vector<Lesson>& lessons,
                         const std::string& source) {
  LessonWriter writer(text, file);
  for (const Lesson& lesson : lessons) writer.add(lesson);
  return writer.text(source);
}

}  // namespace toposcope
