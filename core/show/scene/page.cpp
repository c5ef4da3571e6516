// SPDX-License-Identifier: BSD-3-Clause
#include "scene/page.h"

#include "base/errors.h"

namespace toposcope {

std::string page_with(std::string_view page, std::string_view document, const std::string& file) {
  constexpr std::string_view place = "<script type=\"application/json\" id=\"toposcope-data\">";
  constexpr std::string_view empty = "null";
  const std::size_t begin = page.find(place);
  if (begin == page.npos || page.substr(begin + place.size(), empty.size()) != empty)
    throw UsageError(file + ": is not the page of Toposcope: it has no element toposcope-data for the document; " +
                     "build or install Toposcope anew");
  while (!document.empty() && document.back() == '\n') document.remove_suffix(1);
  std::string text;
  text.reserve(page.size() + document.size() + document.size() / 100);
  text += page.substr(0, begin + place.size());
  // In JSON '<' stands within strings alone; written so, no text can end the script or open a comment.
  for (const char c : document)
    if (c == '<')
      text += "\\u003c";
    else
      text += c;
  return text += page.substr(begin + place.size() + empty.size());
}

}  // namespace toposcope
