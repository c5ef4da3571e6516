// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <exception>
#include <new>
#include <string>
#include <utility>

#include "base/errors.h"

namespace toposcope {

/// Runs a call into a plugin: whatever it throws comes out as a PluginError with the plugin's id, but for what is no
/// fault of the plugin's: that memory is at an end, and errors that the kernel throws through it.
template <class Call>
decltype(auto) guard(const std::string& id, Call&& call) {
  try {
    return std::forward<Call>(call)();
  } catch (const Error&) {
    throw;  // the kernel's own, or of a plugin further in: it knows better
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& error) {
    throw PluginError(id, std::string("threw while running: ") + error.what());
  } catch (...) {
    throw PluginError(id, "threw while running: an exception that is not a std::exception");
  }
}

}  // namespace toposcope
