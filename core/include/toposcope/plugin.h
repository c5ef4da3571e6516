// SPDX-License-Identifier: BSD-3-Clause
#pragma once

// The plugin boundary: one C symbol, `toposcope_plugin`, returns a static descriptor. The loader checks it
// (size, ABI, fingerprint) before it calls anything else. A plugin's source ends with TOPOSCOPE_PLUGIN(...).

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <string>

#include "toposcope/filters.h"
#include "toposcope/labeling.h"
#include "toposcope/options.h"
#include "toposcope/relations.h"
#include "toposcope/shapes.h"
#include "toposcope/worksets.h"

namespace toposcope {

inline constexpr std::uint32_t abi_major = 3;  ///< differs: refused
inline constexpr std::uint32_t abi_minor = 0;  ///< a plugin built against a newer minor is refused

#define TOPOSCOPE_STRINGIFY_(x) #x
#define TOPOSCOPE_STRINGIFY(x) TOPOSCOPE_STRINGIFY_(x)

#if defined(__SANITIZE_ADDRESS__)
#define TOPOSCOPE_SANITIZER_ "address"
#elif defined(__SANITIZE_THREAD__)
#define TOPOSCOPE_SANITIZER_ "thread"
#else
#define TOPOSCOPE_SANITIZER_ "none"
#endif
#if defined(_GLIBCXX_DEBUG)
#define TOPOSCOPE_CONTAINERS_ "debug"
#else
#define TOPOSCOPE_CONTAINERS_ "plain"
#endif
#if defined(NDEBUG)
#define TOPOSCOPE_BUILD_ "release"
#else
#define TOPOSCOPE_BUILD_ "debug"
#endif

/// Everything that must agree for C++ types to cross the boundary.
inline constexpr const char* abi_fingerprint =
    "cxxabi=" TOPOSCOPE_STRINGIFY(__GXX_ABI_VERSION) ";cxx11-strings=" TOPOSCOPE_STRINGIFY(
        _GLIBCXX_USE_CXX11_ABI) ";containers=" TOPOSCOPE_CONTAINERS_ ";build=" TOPOSCOPE_BUILD_
                                ";sanitizer=" TOPOSCOPE_SANITIZER_
                                ";scalar=double;pointer=" TOPOSCOPE_STRINGIFY(__SIZEOF_POINTER__);

static_assert(sizeof(Vec3) == 3 * sizeof(double) && alignof(Vec3) == alignof(double),
              "Vec3 must have the same layout in every plugin");

/// A name that the plugin provides to models: a working-set type, a measure of a shape.
struct ProvidedName {
  const char* name;        ///< '#' stands for 1, 2, 3, ...: `length_#`
  std::int32_t dimension;  ///< power of length (0: a number or an angle)
  const char* meaning;     ///< one line
};

/// What `toposcope_plugin()` returns. Plain C layout; grows at the end only. No pointer to text is null.
struct PluginDescriptor {
  std::uint32_t struct_size;     ///< bytes
  std::uint32_t major;           ///< `abi_major` of the headers that the plugin was built with
  std::uint32_t minor;           ///< `abi_minor` likewise
  const char* fingerprint;       ///< `abi_fingerprint` likewise
  const char* kind;              ///< "worksets", "shapes", "relations", "labelers", "filters"
  const char* id;                ///< lower-case words joined by '-', unique over all kinds
  const char* version;           ///< of the plugin, x.y.z
  const char* summary;           ///< one line
  const char* citation;          ///< paper or section; may be ""
  const char* unit;              ///< relations: unit of the residual, "deg" or "length"; else ""
  std::uint32_t min_arity;       ///< shapes: working sets per feature; relations: features; else 0
  std::uint32_t max_arity;       ///< 0: no upper bound
  std::uint32_t ordered;         ///< relations: 1 where it matters which feature comes first, else 0
  std::int32_t dimension;        ///< shapes: 0 point, 1 line, 2 surface, 3 volume; else -1
  const OptionSpec* options;     ///< set in the pipeline
  std::size_t option_count;      ///< rows of `options`
  const OptionSpec* arguments;   ///< set in the model: `segments` of a line group, `max` of a distance
  std::size_t argument_count;    ///< rows of `arguments`
  const ProvidedName* provides;  ///< working-set types, measures
  std::size_t provided_count;    ///< rows of `provides`
  /// Returns the plugin's object (a pointer to the kind's base class) or null with the reason in `error`. Lets no
  /// exception out. `options` are checked, one value per row of the table, and live no longer than the call.
  void* (*create)(const Options* options, std::string* error);
  /// Deletes what `create` returned.
  void (*destroy)(void* object);
  const char* programs;  ///< that must be on the PATH for the plugin to run, separated by spaces; each is also the name
                         ///< of its Debian package
};

namespace detail {
template <class Base>
struct KindOf;
template <>
struct KindOf<WorkingSetClassifier> {
  static constexpr const char* name = "worksets";
};
template <>
struct KindOf<ShapeFitter> {
  static constexpr const char* name = "shapes";
};
template <>
struct KindOf<RelationTester> {
  static constexpr const char* name = "relations";
};
template <>
struct KindOf<Labeler> {
  static constexpr const char* name = "labelers";
};
template <>
struct KindOf<MeshFilter> {
  static constexpr const char* name = "filters";
};

template <class Base, class Plugin>
void* create(const Options* options, std::string* error) {
  try {
    return static_cast<Base*>(new Plugin(*options));
  } catch (const std::exception& e) {
    *error = e.what();
  } catch (...) {
    *error = "an exception that is not a std::exception";
  }
  return nullptr;
}
template <class Base>
void destroy(void* object) {
  delete static_cast<Base*>(object);
}
}  // namespace detail

/// The author's part of a descriptor; its members mean what the descriptor's do. Tables and texts must live as long as
/// the library: constants at namespace scope. What is wrong is an error of the build, which writes the manifest from
/// it: an id, version or summary that is none; a shape without min_arity of at least 1 or without dimension; a relation
/// without min_arity or unit; a working-set classifier that provides no type; a default outside of its range.
struct PluginInfo {
  const char* id;                               ///< lower-case words joined by '-'
  const char* version;                          ///< x.y.z
  const char* summary;                          ///< one line
  const char* citation = "";                    ///< paper or section
  const char* unit = "";                        ///< relations: of the residual, "deg" or "length"
  std::uint32_t min_arity = 0;                  ///< shapes: working sets per feature; relations: features
  std::uint32_t max_arity = 0;                  ///< 0: no upper bound
  bool ordered = false;                         ///< relations: whether it matters which feature comes first
  std::int32_t dimension = -1;                  ///< shapes: 0 point, 1 line, 2 surface, 3 volume
  std::span<const OptionSpec> options = {};     ///< set in the pipeline
  std::span<const OptionSpec> arguments = {};   ///< set in the model
  std::span<const ProvidedName> provides = {};  ///< working-set types, measures
  const char* programs = "";                    ///< that must be on the PATH, separated by spaces
};

template <class Base, class Plugin>
PluginDescriptor describe(const PluginInfo& info) {
  return {sizeof(PluginDescriptor),
          abi_major,
          abi_minor,
          abi_fingerprint,
          detail::KindOf<Base>::name,
          info.id,
          info.version,
          info.summary,
          info.citation,
          info.unit,
          info.min_arity,
          info.max_arity,
          info.ordered ? 1U : 0U,
          info.dimension,
          info.options.data(),
          info.options.size(),
          info.arguments.data(),
          info.arguments.size(),
          info.provides.data(),
          info.provides.size(),
          &detail::create<Base, Plugin>,
          &detail::destroy<Base>,
          info.programs};
}

#define TOPOSCOPE_PLUGIN_SYMBOL "toposcope_plugin"

/// Makes `Class` (constructible from `const toposcope::Options&`, derived from the kind's base) a plugin:
///   TOPOSCOPE_PLUGIN(ShapeFitter, Circle, {.id = "circle", .version = "1.0.0", .summary = "...", .options = options})
#define TOPOSCOPE_PLUGIN(Base, Class, ...)                                                                    \
  extern "C" __attribute__((visibility("default"))) const ::toposcope::PluginDescriptor* toposcope_plugin() { \
    static const ::toposcope::PluginDescriptor descriptor =                                                   \
        ::toposcope::describe<::toposcope::Base, Class>(::toposcope::PluginInfo __VA_ARGS__);                 \
    return &descriptor;                                                                                       \
  }

}  // namespace toposcope
