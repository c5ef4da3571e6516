// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <string>
#include <utility>

#include "base/errors.h"

namespace toposcope {

/// Runs a call into a plugin: whatever it throws comes out as a PluginError with the plugin's id.
template <class Call>
decltype(auto) guard(const std::string& id, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const PluginError&) {
    throw;  // of a plugin further in: it knows better
  } catch (const std::exception& error) {
    throw PluginError(id, std::string("threw while running: ") + error.what());
  } catch (...) {
    throw PluginError(id, "threw while running: an exception that is not a std::exception");
  }
}

}  // namespace toposcope
