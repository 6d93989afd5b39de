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
  std::vector<std::string> origins = {};      ///< of the last ones of these, what messages show before them; before the others "--set "
  std::optional<double> accuracy = {};        ///< as after --accuracy; wins over the file
  std::vector<std::string> records = {};      ///< paths that are recorded besides those that the file asks for
  bool plotted = false;                       ///< what `[plot]` draws is recorded besides
  std::vector<std::string> without = {};      ///< effects, as after --without: they are left out besides those of the file
  std::optional<std::vector<std::string>> only = {};  ///< as after --only: all others are left out, whatever the file says
  std::vector<std::string> keep = {};         ///< Scene::keep
  bool claims = true;                         ///< false: `[expect]` is not read
  std::vector<std::string> measures = {};     ///< become Scene::claims after those of the file: see measures.hpp
  std::vector<std::filesystem::path> model_folders = {};  ///< folders that `include` falls back on
  FileCache* cache = nullptr;                 ///< for who reads a scene many times
};

struct ReadResult {
  std::optional<Scene> scene;             ///< absent if there is any error
  Presentation presentation;              ///< how the scene wants to be shown; empty if there is any error
  std::vector<Diagnostic> diagnostics;    ///< every mistake found, in the order of files and lines
  Sources sources;
};

/// Reads and checks a netlist; never throws for what a file contains. A file that cannot be opened is a diagnostic too.
ReadResult read_scene(const std::filesystem::path& file, Declarations declarations, const ReadOptions& options = {});

/// The same from text; `name` is what messages call it, `folder` where its includes and tables are looked for.
ReadResult read_scene_text(std::string text, const std::string& name, const std::filesystem::path& folder,
                           Declarations declarations, const ReadOptions& options = {});

/// The JSON Schema (draft 2020-12) of the netlist format, for editors, made from the same declarations.
std::string json_schema(Declarations declarations);

}  // namespace rheonet
