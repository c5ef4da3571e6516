// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

namespace toposcope {

/// The page (web/) with a document to show in it: a scene or an index, as JSON.
/// \param file  of the page, for messages \throw UsageError  it has no place for the document
std::string page_with(std::string_view page, std::string_view document, const std::string& file);

}  // namespace toposcope
