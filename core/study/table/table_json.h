// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <nlohmann/json.hpp>

#include "table/table.h"

namespace toposcope {

/// {id, title, columns: [{name, unit, kind}], rows: [[...]]}, with `links` where rows have them. Nothing is null.
nlohmann::ordered_json to_json(const Table& table);

}  // namespace toposcope
