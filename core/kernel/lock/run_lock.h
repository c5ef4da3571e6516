// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "model/model.h"
#include "pipeline/pipeline_manifest.h"
#include "plugin/catalog.h"

namespace toposcope {

/// A file that a run depends on. Its path is for people: only the hash is compared.
struct LockedFile {
  std::string path, sha256;
};

/// \throw UsageError  it cannot be read
LockedFile locked_file(const std::filesystem::path& path);

struct LockedPlugin {
  std::string kind, id, version;
  LockedFile library;
  std::map<std::string, std::string> options;
  std::vector<LockedFile> programs;  ///< that it runs
};

struct LockedMesh {
  LockedFile file;
  std::vector<LockedFile> parts;  ///< further files that a glTF file names
};

/// The program that runs.
struct LockedProgram {
  std::string version;
  LockedFile file;
};

/// Everything that decides what a run finds (schemas/lock.schema.json): written by `run --lock`, compared by
/// `run --locked`. The number of threads does not decide.
struct RunLock {
  LockedProgram program;
  std::uint64_t seed = 1;
  std::string pipeline;  ///< its name; what it says is in the plugins' options
  std::map<std::string, std::string> resolution, probability;
  LockedFile model;
  std::vector<LockedPlugin> plugins;  ///< in the order in which the run uses them
  std::vector<LockedMesh> meshes;
};

/// Of a run that is about to begin. Loads no plugin: a library that was changed must not run before it is compared.
/// \throw UsageError, PluginError, MeshError
RunLock lock_run(const LockedProgram& program, std::uint64_t seed, const PipelineManifest& pipeline, const Model& model,
                 const std::vector<std::filesystem::path>& meshes, const PluginCatalog& catalog);

std::string to_json(const RunLock& lock);
/// \throw UsageError  it is no lock file
RunLock read_lock(const std::filesystem::path& file);

/// \throw Error  naming everything in which this run differs from the locked one. Its exit code is that of the first:
///        2 program, seed, pipeline or model, 4 plugin, 3 mesh
void require_same(const RunLock& locked, const RunLock& now, const std::filesystem::path& lock_file);

}  // namespace toposcope
