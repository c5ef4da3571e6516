// SPDX-License-Identifier: BSD-3-Clause
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/assignment.h"
#include "base/errors.h"
#include "base/file_name.h"
#include "commands.h"
#include "io/mesh_io.h"
#include "options.h"
#include "output.h"
#include "output_folder.h"
#include "pipeline/filters.h"
#include "plugin/option_check.h"
#include "result/preparation.h"
#include "session.h"

namespace toposcope::cli {
namespace {

struct PrepareOptions : CommonOptions {
  std::vector<fs::path> meshes;
  fs::path out;
  std::optional<std::uint32_t> faces, decimate;
  std::optional<double> edge;  ///< in the mesh's own unit
  std::string smooth;          ///< passes; empty: not asked for
};

constexpr std::uint64_t most_faces = 100'000'000;

/// A filter that the command line asks for.
struct Step {
  std::string flag;  ///< for messages
  std::string id;
  std::vector<GivenOption> options;
};

/// In the order in which they are applied.
std::vector<Step> steps_of(const PrepareOptions& options) {
  std::vector<Step> steps;
  if (!options.smooth.empty()) steps.push_back({"--smooth", "taubin", {{"passes", options.smooth}}});
  if (options.decimate) steps.push_back({"--decimate", "decimate", {{"faces", std::to_string(*options.decimate)}}});
  if (options.faces) steps.push_back({"--faces", "normalise", {{"faces", std::to_string(*options.faces)}}});
  if (options.edge) steps.push_back({"--edge", "normalise", {}});  // its length is relative to each mesh
  for (const std::string& setting : options.overrides) {
    const auto option = split_assignment(setting);
    const std::size_t dot = option ? option->first.find('.', 8) : std::string::npos;
    if (!setting.starts_with("filters.") || dot == std::string::npos)
      throw UsageError("--set '" + setting + "': expected filters.ID.option=value");
    const std::string id = setting.substr(8, dot - 8);
    const auto step = std::find_if(steps.begin(), steps.end(), [&](const Step& s) { return s.id == id; });
    if (step == steps.end())
      throw UsageError("--set '" + setting + "': filter '" + id +
                       "' is not applied; --smooth applies taubin, --decimate decimate, --faces and --edge normalise");
    step->options.emplace_back(option->first.substr(dot + 1), option->second);
  }
  return steps;
}

const PluginManifest& manifest_of(const Step& step, const PluginCatalog& catalog) try {
  return catalog.require(PluginKind::filters, step.id, step.flag);
} catch (const UsageError& error) {  // the user asked for no plugin by name, so that it is no matter of usage
  throw PluginError(step.id, error.what());
}

std::vector<OptionValue> checked_options(const Step& step, const PluginManifest& manifest) {
  return check_options(manifest.options, step.options, step.flag + ": filter '" + step.id + "'");
}

/// \param diagonal  of the mesh's box
Step for_mesh(Step step, const PrepareOptions& options, double diagonal) {
  if (step.flag != "--edge") return step;
  if (*options.edge > diagonal)
    throw UsageError(fmt::format("--edge {}: longer than the mesh, whose box has a diagonal of {:.4g}; give less",
                                 *options.edge, diagonal));
  step.options.emplace_back("edge", fmt::format("{}", *options.edge / diagonal));
  return step;
}

bool is_folder(const PrepareOptions& options) {
  std::error_code ignored;
  return options.meshes.size() > 1 || options.out.filename().empty() || fs::is_directory(options.out, ignored);
}

/// Where a mesh goes; empty: nowhere.
fs::path target_of(const PrepareOptions& options, const fs::path& mesh) {
  if (options.out.empty() || !is_folder(options)) return options.out;
  return options.out / (file_name(mesh.stem().string()) + ".ply");
}

void check_output(const PrepareOptions& options) {
  if (options.out.empty()) return;
  if (!is_folder(options)) {
    if (!can_write_mesh(options.out))
      throw UsageError("-o " + options.out.string() + ": write a mesh as .ply, .obj, .stl or .off, or name a folder");
    return;  // the input itself may be named, then it is replaced
  }
  refuse_same_stem(options.meshes, "-o");
  for (const fs::path& mesh : options.meshes) {
    std::error_code ignored;
    for (const fs::path& other : options.meshes)
      if (fs::equivalent(target_of(options, mesh), other, ignored))
        throw UsageError("-o " + options.out.string() + ": would write over the input " + other.string() +
                         "; name another folder, or for one mesh the file itself");
  }
  make_folder(options.out, "-o");
}

class Preparer {
 public:
  Preparer(const PrepareOptions& options, Session& session)
      : options_(options), session_(session), steps_(steps_of(options)) {
    for (const Step& step : steps_) {
      checked_options(step, manifest_of(step, session_.host().catalog()));
      session_.host().load(PluginKind::filters, step.id);
    }
  }

  Preparation prepare(const fs::path& path) const {
    Preparation done;
    done.mesh_path = path.string();
    TriangleSoup soup = read_soup(path);
    done.file_vertices = static_cast<Index>(soup.positions.size());
    done.file_faces = soup.input_faces;
    RepairedMesh made = repaired_mesh(std::move(soup), done.mesh_path, &session_.context());
    done.repair = made.repair;
    done.repaired = summary_of(made.mesh.view(), made.repair);
    if (!steps_.empty()) {
      made = filtered(made.mesh, done);
      done.prepared = summary_of(made.mesh.view(), made.repair);
    }
    const fs::path target = target_of(options_, path);
    stop_if_cancelled(session_.context(), done.mesh_path + " was not prepared");
    if (target.empty()) return done;
    const std::string lost = write_mesh(target, made.mesh.view().positions, made.mesh.view().triangles,
                                        {.input_faces = made.mesh.face_origin()});
    if (!lost.empty()) session_.context().log(LogLevel::warning, lost);
    done.written = target.string();
    return done;
  }

 private:
  /// What a filter leaves is repaired again: it may have made faces without area.
  RepairedMesh filtered(const Mesh& mesh, Preparation& done) const {
    const Box& box = mesh.view().box;
    const double diagonal = std::hypot(box.a(), box.b(), box.c());
    std::vector<FilterStation> filters;
    for (const Step& each : steps_) {
      const Step step = for_mesh(each, options_, diagonal);
      filters.push_back(make_filter(session_.host(), step.id, step.options, step.flag));
      done.filters.push_back(filters.back().use);
    }
    const PreparedMesh after = apply_filters(mesh, filters, session_.context());
    const MeshView& view = after.view();
    TriangleSoup soup{{view.positions.begin(), view.positions.end()},
                      {view.triangles.begin(), view.triangles.end()},
                      {},
                      mesh.input_faces()};
    soup.face_origin.reserve(after.origin.size());
    for (Index f : after.origin) soup.face_origin.push_back(mesh.face_origin()[f]);
    return repaired_mesh(std::move(soup), done.mesh_path + ": after the filters", &session_.context());
  }

  const PrepareOptions& options_;
  Session& session_;
  std::vector<Step> steps_;
};

/// `--smooth scan.ply` means the default and a mesh.
void sort_out_smooth(const CLI::Option* smooth, PrepareOptions& options) {
  if (smooth->count() == 0) return;
  const std::string given = options.smooth;
  const bool number = !given.empty() && given.find_first_not_of("+-.0123456789eE") == given.npos;
  if (number) return;
  options.smooth = "10";
  if (!given.empty()) options.meshes.insert(options.meshes.begin(), given);
}

int prepare(const PrepareOptions& options) {
  if (options.edge && !(*options.edge > 0 && std::isfinite(*options.edge)))
    throw UsageError("--edge: expected a length above 0, in the mesh's own unit");
  Session session(options);
  const Preparer preparer(options, session);
  check_output(options);
  return for_each_mesh(options.meshes, session, [&](const fs::path& path) {
    const Preparation done = preparer.prepare(path);
    session.status("");
    if (options.json)
      say("{}", to_json_line(done));
    else if (!options.quiet)
      say("{}\n", to_text(done));
    flush_output();
  });
}

}  // namespace

void add_prepare(CLI::App& app, int& code) {
  CLI::App& command = *app.add_subcommand("prepare", "repair meshes, change their resolution, say what they are like");
  const auto options = std::make_shared<PrepareOptions>();
  add_meshes(command, options->meshes);
  command.add_option("-o,--out", options->out, "mesh to write; of several meshes, or with a folder: DIR/<mesh>.ply")
      ->type_name("MESH|DIR");
  CLI::Option* smooth = command.add_option("--smooth", options->smooth, "smooth without shrinking; 10 passes")
                            ->type_name("[PASSES]")
                            ->expected(0, 1);
  command.add_option("--decimate", options->decimate, "fewer faces, the shape kept as well as can be")
      ->type_name("N")
      ->check(whole_number(1, most_faces));
  CLI::Option* faces = command.add_option("--faces", options->faces, "even edges, about N faces")
                           ->type_name("N")
                           ->check(whole_number(1, most_faces));
  command.add_option("--edge", options->edge, "even edges of about length L, in the mesh's unit")
      ->type_name("L")
      ->excludes(faces);
  command.add_flag("--json", options->json, "print a JSON object per mesh");
  add_session(command, *options);
  command.callback([options, smooth, &code] {
    sort_out_smooth(smooth, *options);
    if (options->meshes.empty()) throw CLI::RequiredError("mesh");
    code = prepare(*options);
  });
}

}  // namespace toposcope::cli
