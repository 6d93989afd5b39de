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
  std::vector<std::string> overrides;         ///< "PATH=VALUE", as after --set.
  std::vector<std::string> origins = {};      ///< Prefixes of the last overrides in messages; others have "--set ".
  std::optional<double> accuracy = {};        ///< As after --accuracy; wins over the file.
  std::vector<std::string> records = {};      ///< Paths recorded in addition to those of the file.
  bool plotted = false;                       ///< The records that `[plot]` draws are recorded too.
  std::vector<std::string> without = {};      ///< Effects, as after --without: left out in addition to those of the file.
  std::optional<std::vector<std::string>> only = {};  ///< As after --only: leaves out all others; replaces the `[effects]` of the file.
  std::vector<std::string> keep = {};         ///< Scene::keep
  bool claims = true;                         ///< false: `[expect]` is not read.
  std::vector<std::string> measures = {};     ///< Added to Scene::claims after those of the file: see measures.hpp.
  std::vector<std::filesystem::path> model_folders = {};  ///< Folders that `include` falls back on.
  FileCache* cache = nullptr;                 ///< For callers that read a scene many times.
};

struct ReadResult {
  std::optional<Scene> scene;             ///< Absent if there is any error.
  Presentation presentation;              ///< How to display the scene; empty if there is any error.
  std::vector<Diagnostic> diagnostics;    ///< Every mistake found, in the order of files and lines.
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
