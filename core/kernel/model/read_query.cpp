// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <string_view>

#include "base/errors.h"
#include "base/nearest_name.h"
#include "model/ask.h"
#include "model/model_reading.h"

namespace toposcope {
namespace {

using Words = std::vector<std::string>;

constexpr const char* forms =
    "ask as in: what bounds the OBJECT? what is the OBJECT part of? is the OBJECT above the OTHER? OBJECT adjacent-to "
    "?";

/// Lower-case words: a change of case, '-', '_' and space part them, and '?' is a word.
Words query_words(std::string_view text) {
  Words words;
  bool open = false;
  char before = ' ';
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalnum(letter) == 0 && letter < 0x80) {
      open = false;
      if (c == '?') words.emplace_back("?");
    } else {
      const bool hump = std::isupper(letter) != 0 && std::islower(static_cast<unsigned char>(before)) != 0;
      if (!open || hump) words.emplace_back();
      words.back() += static_cast<char>(std::tolower(letter));
      open = true;
    }
    before = c;
  }
  return words;
}

struct Phrase {
  std::string_view words, relation;
};

/// How relations are said, longer before shorter ones that they begin with.
constexpr std::array<Phrase, 45> phrases = {{{"bounded by", "bounded-by"},
                                             {"boundary of", "boundary-of"},
                                             {"boundaries of", "boundary-of"},
                                             {"bounds", "boundary-of"},
                                             {"bound", "boundary-of"},
                                             {"has part", "has-part"},
                                             {"has parts", "has-part"},
                                             {"have part", "has-part"},
                                             {"have parts", "has-part"},
                                             {"contains", "has-part"},
                                             {"contain", "has-part"},
                                             {"part of", "part-of"},
                                             {"parts of", "part-of"},
                                             {"adjacent to", "adjacent-to"},
                                             {"next to", "adjacent-to"},
                                             {"touches", "adjacent-to"},
                                             {"touch", "adjacent-to"},
                                             {"up of", "up"},
                                             {"superior to", "up"},
                                             {"above", "up"},
                                             {"over", "up"},
                                             {"down of", "down"},
                                             {"inferior to", "down"},
                                             {"below", "down"},
                                             {"under", "down"},
                                             {"in front of", "front"},
                                             {"front of", "front"},
                                             {"anterior to", "front"},
                                             {"at the back of", "back"},
                                             {"back of", "back"},
                                             {"posterior to", "back"},
                                             {"behind", "back"},
                                             {"to the right of", "right"},
                                             {"right of", "right"},
                                             {"to the left of", "left"},
                                             {"left of", "left"},
                                             {"up", "up"},
                                             {"down", "down"},
                                             {"front", "front"},
                                             {"back", "back"},
                                             {"right", "right"},
                                             {"left", "left"},
                                             {"composed of", "has-part"},
                                             {"made of", "has-part"},
                                             {"consist of", "has-part"}}};

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> list) {
  return std::find(list.begin(), list.end(), word) != list.end();
}

/// Words that say nothing about which object is meant.
Words without_filler(const Words& words) {
  Words kept;
  for (const std::string& word : words)
    if (!is_one_of(word, {"the", "a", "an", "all", "its", "are", "is", "does", "do", "lies", "lie", "that", "objects",
                          "object", "things"}))
      kept.push_back(word);
  return kept;
}

int dimension_word(const std::string& word) {
  constexpr std::array<std::string_view, 4> kinds = {"point", "line", "surface", "volume"};
  for (std::size_t d = 0; d < kinds.size(); ++d)
    if (word == kinds[d] || word == std::string(kinds[d]) + "s") return static_cast<int>(d);
  return -1;
}

class QueryReader {
 public:
  QueryReader(const std::string& text, const Model& model) : text_(text), model_(model) {
    for (const SpatialObject& object : model.abstract.objects) named_.push_back(query_words(object.name));
  }

  AbstractQuery read() const {
    AbstractQuery query;
    query.text = text_;
    Words words = query_words(text_);
    // The mark at the end of a sentence, but not the one that stands for what is asked for.
    const bool sentence =
        !words.empty() && is_one_of(words.front(), {"what", "which", "is", "are", "does", "do", "who", "where"});
    if (sentence && words.back() == "?") words.pop_back();
    if (words.empty()) throw UsageError("the question is empty; " + std::string(forms));
    const auto [begin, end, relation] = find_relation(words);
    query.relation = relation;
    const Words before(words.begin(), words.begin() + begin), after(words.begin() + end, words.end());
    if (relation.empty())
      query.subject = object(subject_alone(words));
    else
      read_sides(before, without_filler(after), query);
    return query;
  }

 private:
  struct Place {
    std::ptrdiff_t begin, end;
    std::string relation;
  };

  /// The longest phrase that does not stand in the name of an object ("left" of a left lung); of equals the first.
  Place find_relation(const Words& words) const {
    Place best{0, 0, ""};
    for (const Phrase& phrase : phrases) {
      const Words sought = query_words(phrase.words);
      for (auto at = words.begin();; ++at) {
        at = std::search(at, words.end(), sought.begin(), sought.end());
        if (at == words.end()) break;
        const auto begin = at - words.begin();
        const auto end = begin + static_cast<std::ptrdiff_t>(sought.size());
        if (in_a_name(words, begin, end)) continue;
        const auto length = end - begin, longest = best.end - best.begin;
        if (length > longest || (length == longest && begin < best.begin))
          best = {begin, end, std::string(phrase.relation)};
      }
    }
    return best;
  }

  /// Whether the words and one beside them stand so in a name, and do not begin a side of the question.
  bool in_a_name(const Words& words, std::ptrdiff_t begin, std::ptrdiff_t end) const {
    const auto stands = [&](std::ptrdiff_t first, std::ptrdiff_t last) {
      return std::any_of(named_.begin(), named_.end(), [&](const Words& name) {
        return std::search(name.begin(), name.end(), words.begin() + first, words.begin() + last) != name.end();
      });
    };
    if (begin > 0 && stands(begin - 1, end)) return true;
    return end < static_cast<std::ptrdiff_t>(words.size()) && stands(begin, end + 1);
  }

  static Words subject_alone(const Words& words) {
    Words rest = without_filler(words);
    while (!rest.empty() && is_one_of(rest.front(), {"what", "which", "?"})) rest.erase(rest.begin());
    return rest;
  }

  void read_sides(const Words& before, const Words& after, AbstractQuery& query) const {
    Words left = without_filler(before);
    const bool asks = left.empty() || is_one_of(left.front(), {"what", "which", "?"});
    if (asks && !left.empty()) left.erase(left.begin());
    if (asks && !after.empty() && after.front() != "?") {
      if (!left.empty()) query.dimension = dimension_word(left.front());
      if (left.size() > 1 || (left.size() == 1 && query.dimension < 0))
        throw UsageError("'" + text_ + "': asks for what is on both sides of '" + query.relation + "'; " + forms);
      query.object = object(after);
      return;
    }
    // In the singular it may be part of a name: the surface of the lung.
    if (left.size() > 1 && asks && left.front().back() == 's' && dimension_word(left.front()) >= 0) {
      query.dimension = dimension_word(left.front());
      left.erase(left.begin());
    }
    query.subject = object(left);
    if (!after.empty() && after.front() != "?" && after.front() != "what") query.object = object(after);
  }

  /// By its name; else by its first words, else by any: of several the one of fewest words.
  Index object(const Words& words) const {
    const auto fitting = [&](const auto& fits) {
      std::vector<Index> found;
      std::size_t fewest = std::numeric_limits<std::size_t>::max();
      for (Index i = 0; i < named_.size(); ++i) {
        if (!fits(named_[i]) || named_[i].size() > fewest) continue;
        if (named_[i].size() < fewest) found.clear();
        fewest = named_[i].size();
        found.push_back(i);
      }
      return found;
    };
    std::string called;
    for (const std::string& word : words) called += (called.empty() ? "" : "-") + word;
    called.resize(std::min<std::size_t>(called.size(), 100));
    if (words.empty()) throw UsageError("'" + text_ + "': no object is named; " + forms);
    std::vector<Index> found = fitting([&](const Words& name) { return name == words; });
    if (found.empty())
      found = fitting([&](const Words& name) {
        return name.size() > words.size() && std::equal(words.begin(), words.end(), name.begin());
      });
    if (found.empty())
      found = fitting([&](const Words& name) {
        return std::all_of(words.begin(), words.end(), [&](const std::string& word) {
          return std::find(name.begin(), name.end(), word) != name.end();
        });
      });
    if (found.size() == 1) return found.front();
    const std::vector<std::string> names = names_of(model_.abstract.objects);
    if (found.empty())
      throw UsageError("'" + text_ + "': model '" + model_.name + "' has no object '" + called + "'; " +
                       name_remedy(nearest_beginning(called, names), names));
    std::string list;
    for (const Index each : found) list += (list.empty() ? "" : ", ") + names[each];
    throw UsageError("'" + text_ + "': '" + called + "' may be any of " + list + "; say more of its name");
  }

  /// The name whose beginning is nearest to what was called, where no whole name is.
  static std::string nearest_beginning(const std::string& called, const std::vector<std::string>& names) {
    if (!nearest_name(called, names).empty()) return called;
    std::vector<std::string> beginnings;
    for (const std::string& name : names) beginnings.push_back(name.substr(0, called.size()));
    const std::string nearest = nearest_name(called, beginnings);
    for (const std::string& name : names)
      if (!nearest.empty() && name.starts_with(nearest)) return name;
    return called;
  }

  const std::string& text_;
  const Model& model_;
  std::vector<Words> named_;
};

}  // namespace

AbstractQuery read_query(const std::string& text, const Model& model) {
  if (model.abstract.objects.empty())
    throw UsageError(model.file + ": model '" + model.name +
                     "' has no abstract part to ask; add 'objects', and the networks over them");
  return QueryReader(text, model).read();
}

}  // namespace toposcope
