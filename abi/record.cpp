// SPDX-License-Identifier: BSD-3-Clause
// Prints the layout of everything that crosses the plugin boundary, a line each: sizes, members with offset and size,
// values of enumerations, slots of virtual functions. The recorded ABIs lie beside this file (docs/guide/abi.md).

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "toposcope/plugin.h"

namespace {

using namespace toposcope;

[[noreturn]] void fail(const std::string& message) {
  std::fprintf(stderr, "abi_record: %s\n", message.c_str());
  std::exit(1);
}

struct Member {
  const char* name;
  std::size_t offset, size, alignment;
};

/// One of every type, never touched: only its addresses count.
template <class T>
struct Layout {
  T object{};
  std::vector<Member> members;

  template <class M>
  void add(const char* name, const M& member) {
    const auto offset = reinterpret_cast<const char*>(&member) - reinterpret_cast<const char*>(&object);
    // A member may be a pointer, whose own size is meant. NOLINTNEXTLINE(bugprone-sizeof-expression)
    members.push_back({name, static_cast<std::size_t>(offset), sizeof(M), alignof(M)});
  }
  /// \throw nothing, but ends the program where bytes are left over: a member is not recorded
  void print(const char* type) const {
    std::printf("size %s %zu align %zu\n", type, sizeof(T), alignof(T));
    std::size_t end = 0;
    for (const Member& m : members) {
      std::printf("member %s.%s %zu size %zu\n", type, m.name, m.offset, m.size);
      if (m.offset != (end + m.alignment - 1) / m.alignment * m.alignment)
        fail(std::string(type) + ": something lies before '" + m.name +
             "' that is not recorded; add it to abi/record.cpp");
      end = m.offset + m.size;
    }
    if (sizeof(T) != (end + alignof(T) - 1) / alignof(T) * alignof(T))
      fail(std::string(type) + ": something lies after its last member that is not recorded; add it to abi/record.cpp");
  }
};

/// Index in the virtual table of a virtual function (Itanium C++ ABI 2.3: one more than its offset in bytes).
template <class Function>
std::size_t slot(Function function) {
  std::size_t words[2]{};
  static_assert(sizeof words == sizeof function);
  std::memcpy(words, &function, sizeof words);
  if (words[0] % 2 == 0) fail("a recorded function is not virtual");
  return (words[0] - 1) / sizeof(void*);
}

/// Entries of an object's virtual table, without the two words before them.
std::size_t table_length(const void* object) {
  Dl_info info{};
  ElfW(Sym)* symbol = nullptr;
  const void* table = *static_cast<const void* const*>(object);
  if (dladdr1(table, &info, reinterpret_cast<void**>(&symbol), RTLD_DL_SYMENT) == 0 || symbol == nullptr)
    fail("the program has no symbol for a virtual table; link it with -rdynamic");
  return symbol->st_size / sizeof(void*) - 2;
}

#define MEMBER(name) layout.add(#name, layout.object.name);
#define STRUCT(Type, ...) \
  {                       \
    Layout<Type> layout;  \
    __VA_ARGS__           \
    layout.print(#Type);  \
  }
#define VALUE(Enum, value) std::printf("value " #Enum "::" #value " %ld\n", static_cast<long>(Enum::value))
#define SLOT(Class, function)                                                  \
  std::printf("slot " #Class "::" #function " %zu\n", slot(&Class::function)); \
  ++recorded;
/// The destructor takes the first two entries; every other must be recorded.
#define INTERFACE(Class, object, ...)                                                                   \
  {                                                                                                     \
    std::size_t recorded = 2;                                                                           \
    __VA_ARGS__                                                                                         \
    std::printf("slots " #Class " %zu\n", table_length(&(object)));                                     \
    if (recorded != table_length(&(object))) fail(#Class ": a virtual function of it is not recorded"); \
  }

void print_options() {
  VALUE(OptionType, real);
  VALUE(OptionType, integer);
  VALUE(OptionType, boolean);
  VALUE(OptionType, text);
  STRUCT(OptionSpec, MEMBER(name) MEMBER(type) MEMBER(unit) MEMBER(default_value) MEMBER(minimum) MEMBER(maximum)
                         MEMBER(meaning) MEMBER(choices) MEMBER(not_above))
  STRUCT(OptionValue, MEMBER(name) MEMBER(number) MEMBER(text))
  std::printf("size Options %zu\n", sizeof(Options));
  STRUCT(ProvidedName, MEMBER(name) MEMBER(dimension) MEMBER(meaning))
  STRUCT(PluginDescriptor,
         MEMBER(struct_size) MEMBER(major) MEMBER(minor) MEMBER(fingerprint) MEMBER(kind) MEMBER(id) MEMBER(version)
             MEMBER(summary) MEMBER(citation) MEMBER(unit) MEMBER(min_arity) MEMBER(max_arity) MEMBER(ordered)
                 MEMBER(dimension) MEMBER(options) MEMBER(option_count) MEMBER(arguments) MEMBER(argument_count)
                     MEMBER(provides) MEMBER(provided_count) MEMBER(create) MEMBER(destroy) MEMBER(programs))
}

void print_geometry() {
  std::printf("size Vec3 %zu align %zu\nsize Index %zu\nsize Triangle %zu\n", sizeof(Vec3), alignof(Vec3),
              sizeof(Index), sizeof(Triangle));
  STRUCT(Box, MEMBER(center) MEMBER(axes) MEMBER(sides))
  STRUCT(MeshView, MEMBER(positions) MEMBER(triangles) MEMBER(neighbor_offsets) MEMBER(neighbors) MEMBER(face_offsets)
                       MEMBER(faces) MEMBER(box) MEMBER(mean_edge) MEMBER(input_vertices))
}

void print_shapes() {
  VALUE(Orientation, none);
  VALUE(Orientation, plane_like);
  VALUE(Orientation, line_like);
  VALUE(Termination, closed_form);
  VALUE(Termination, converged);
  VALUE(Termination, iteration_limit);
  VALUE(Termination, failed);
  VALUE(Termination, degenerate);
  STRUCT(FitSummary, MEMBER(termination) MEMBER(message) MEMBER(iterations) MEMBER(initial_cost) MEMBER(final_cost))
  STRUCT(ShapeParameter, MEMBER(name) MEMBER(columns) MEMBER(values))
  STRUCT(Measure, MEMBER(name) MEMBER(value) MEMBER(sd))
  STRUCT(FittedShape, MEMBER(summary) MEMBER(parameters) MEMBER(measures) MEMBER(covariance_of) MEMBER(covariance)
                          MEMBER(orientation) MEMBER(direction) MEMBER(direction_sd) MEMBER(centroid)
                              MEMBER(centroid_sd) MEMBER(outline) MEMBER(outline_closed) MEMBER(rms) MEMBER(explained)
                                  MEMBER(unexplained) MEMBER(coverage))
  STRUCT(FitInput, MEMBER(points) MEMBER(areas) MEMBER(set_offsets) MEMBER(set_boxes) MEMBER(box) MEMBER(object_box)
                       MEMBER(mean_edge) MEMBER(integrated_mean_curvature) MEMBER(mesh) MEMBER(vertices))
  STRUCT(Interval, MEMBER(low) MEMBER(high))
}

void print_relations_and_labeling() {
  STRUCT(RelationOperand, MEMBER(shape) MEMBER(points) MEMBER(box) MEMBER(vertices))
  STRUCT(RelationInput, MEMBER(features) MEMBER(object_box) MEMBER(mean_edge) MEMBER(mesh))
  STRUCT(RelationResult, MEMBER(applicable) MEMBER(why) MEMBER(residual) MEMBER(tolerance) MEMBER(sd) MEMBER(dof)
                             MEMBER(slack) MEMBER(clutter_density) MEMBER(samples))
  STRUCT(LabelingVariable,
         MEMBER(name) MEMBER(detectability) MEMBER(candidates) MEMBER(costs) MEMBER(optional) MEMBER(value_names))
  STRUCT(LabelingConstraint, MEMBER(name) MEMBER(scope) MEMBER(costs) MEMBER(violations))
  STRUCT(LabelingProblem, MEMBER(name) MEMBER(variables) MEMBER(constraints) MEMBER(constant) MEMBER(candidate_count)
                              MEMBER(conflict_bits))
  STRUCT(LabelingRequest, MEMBER(k_best) MEMBER(time_limit_s) MEMBER(within))
  STRUCT(Labeling, MEMBER(values) MEMBER(cost))
  STRUCT(RemovedValue, MEMBER(variable) MEMBER(value) MEMBER(reason))
  STRUCT(LabelingFact, MEMBER(name) MEMBER(value))
  VALUE(Exactness, none);
  VALUE(Exactness, exact);
  VALUE(Exactness, bound);
  VALUE(Exactness, approximate);
  STRUCT(LabelingOutcome,
         MEMBER(labelings) MEMBER(lower_bound) MEMBER(optimal) MEMBER(log_evidence) MEMBER(evidence_exactness)
             MEMBER(evidence_error) MEMBER(posteriors) MEMBER(posterior_exactness) MEMBER(posterior_error) MEMBER(nodes)
                 MEMBER(guarantee) MEMBER(removed) MEMBER(facts))
}

}  // namespace

/// Objects of every interface, with tables of their own. Outside of the unnamed namespace: their tables need symbols.
namespace abi_record {
using namespace toposcope;
struct AContext final : Context {
  void log(LogLevel, std::string_view) override {}
  void progress(double) override {}
  bool cancelled() const override { return false; }
  std::uint64_t seed() const override { return 0; }
  unsigned threads() const override { return 1; }
  void parallel_for(std::size_t, std::size_t, const std::function<void(std::size_t, std::size_t)>&) override {}
  std::uint64_t memory_budget() const override { return 0; }
};
struct AWorkingSetSink final : WorkingSetSink {
  void add(std::string_view, std::span<const Index>, double) override {}
};
struct AClassifier final : WorkingSetClassifier {
  void classify(const MeshView&, Context&, WorkingSetSink&) const override {}
};
struct AFitter final : ShapeFitter {
  FittedShape fit(const FitInput&, const Options&, Context&) const override { return {}; }
  double distance(const FittedShape&, const Vec3&) const override { return 0; }
};
struct ATester final : RelationTester {
  RelationResult test(const RelationInput&, const Options&, Context&) const override { return {}; }
};
struct ALabeler final : Labeler {
  LabelingOutcome solve(const LabelingProblem&, const LabelingRequest&, Context&) const override { return {}; }
};
struct AMeshSink final : MeshSink {
  void set(std::span<const Vec3>, std::span<const Triangle>, std::span<const Index>, std::span<const Index>) override {}
};
struct AFilter final : MeshFilter {
  void apply(const MeshView&, Context&, MeshSink&) const override {}
};
}  // namespace abi_record

namespace {

void print_interfaces() {
  using namespace abi_record;
  VALUE(LogLevel, debug);
  VALUE(LogLevel, info);
  VALUE(LogLevel, warning);
  VALUE(LogLevel, error);
  const AContext context;
  INTERFACE(Context, context,
            SLOT(Context, log) SLOT(Context, progress) SLOT(Context, cancelled) SLOT(Context, seed)
                SLOT(Context, threads) SLOT(Context, parallel_for) SLOT(Context, memory_budget))
  const AWorkingSetSink sets;
  INTERFACE(WorkingSetSink, sets, SLOT(WorkingSetSink, add))
  const AClassifier classifier;
  INTERFACE(WorkingSetClassifier, classifier, SLOT(WorkingSetClassifier, classify))
  const AFitter fitter;
  INTERFACE(ShapeFitter, fitter, SLOT(ShapeFitter, fit) SLOT(ShapeFitter, distance) SLOT(ShapeFitter, bounds))
  const ATester tester;
  INTERFACE(RelationTester, tester, SLOT(RelationTester, test))
  const ALabeler labeler;
  INTERFACE(Labeler, labeler, SLOT(Labeler, solve))
  const AMeshSink mesh;
  INTERFACE(MeshSink, mesh, SLOT(MeshSink, set))
  const AFilter filter;
  INTERFACE(MeshFilter, filter, SLOT(MeshFilter, apply))
}

}  // namespace

int main() {
  std::printf("abi %u.%u\nsymbol %s\n", abi_major, abi_minor, TOPOSCOPE_PLUGIN_SYMBOL);
  print_options();
  print_geometry();
  print_shapes();
  print_relations_and_labeling();
  print_interfaces();
  return 0;
}
