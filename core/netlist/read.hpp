#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/netlist/declaration.hpp"
#include "core/netlist/diagnostic.hpp"
#include "core/netlist/file_cache.hpp"
#include "core/netlist/presentation.hpp"
#include "core/netlist/scene.hpp"

namespace rheonet {

struct ReadOptions {
  std::vector<std::string> overrides;         ///< "PATH=VALUE", as after --set
  std::vector<std::string> origins = {};      ///< prefixes of the last overrides in messages; others have "--set "
  std::optional<double> accuracy = {};        ///< as after --accuracy; wins over the file
  std::vector<std::string> records = {};      ///< paths recorded in addition to those of the file
  bool plotted = false;                       ///< the records that `[plot]` draws are recorded too
  std::vector<std::string> without = {};      ///< effects, as after --without: left out in addition to those of the file
  std::optional<std::vector<std::string>> only = {};  ///< as after --only: leaves out all others; replaces the `[effects]` of the file
  std::vector<std::string> keep = {};         ///< Scene::keep
  bool claims = true;                         ///< false: `[expect]` is not read
  std::vector<std::string> measures = {};     ///< added to Scene::claims after those of the file: see measures.hpp
  std::vector<std::filesystem::path> model_folders = {};  ///< folders that `include` falls back on
  FileCache* cache = nullptr;                 ///< for callers that read a scene many times
};

struct ReadResult {
  std::optional<Scene> scene;             ///< absent if there is any error
  Presentation presentation;              ///< how to display the scene; empty if there is any error
  std::vector<Diagnostic> diagnostics;    ///< every mistake found, in the order of files and lines
  Sources sources;
};

/// Reads and checks a netlist. Never throws because of a file's contents; an unreadable file is a diagnostic too.
ReadResult read_scene(const std::filesystem::path& file, Declarations declarations, const ReadOptions& options = {});

/// The same from text. `name` stands for the file in messages; includes and tables are searched for in `folder`.
ReadResult read_scene_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                           Declarations declarations, const ReadOptions& options = {});

/// The JSON Schema (draft 2020-12) of the netlist format, for editors, made from the same declarations.
std::string json_schema(Declarations declarations);

}  // namespace rheonet
