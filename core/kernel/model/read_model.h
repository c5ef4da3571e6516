// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include "model/model.h"
#include "plugin/catalog.h"

namespace toposcope {

/// Reads and checks a model file: first against schemas/model.schema.json, then what it means (dimensions, names,
/// cycles; plugins, their measures and arguments).
/// \param catalog  null: what only the plugins' manifests know is not checked
/// \throw UsageError  all errors of the step that failed, one a line: `file:line:column: what is wrong; remedy`
/// \throw PluginError  the model names a plugin that is there but cannot be used
Model read_model(const std::filesystem::path& file, const PluginCatalog* catalog);

/// The same from the text of a file. \param file  its name, for messages
Model model_from_text(const std::string& text, const std::string& file, const PluginCatalog* catalog);

}  // namespace toposcope
