#include "core/netlist/include.hpp"

#include <algorithm>
#include <set>

#include "core/netlist/table_reader.hpp"

namespace rheonet {

namespace {

namespace fs = std::filesystem;

// Limit on nested includes: each level takes stack.
constexpr std::size_t most_including = 100;

class Includer {
 public:
  Includer(Context& context, const fs::path& main) : context_(context) { open_.push_back({main, main.filename()}); }

  void read(const TomlValue& document) {
    const TomlEntry* include = document.find("include");
    if (!include) return;
    const std::string hint = "include = [\"library/rheology.toml\"]";
    if (!expect_array(include->value, "`include`", context_.diagnostics, hint)) return;
    for (const TomlValue& name : include->value.items)
      if (expect_string(name, "the name of a file", context_.diagnostics, hint)) read_file(name);
  }

  std::deque<IncludedFile> files;

 private:
  struct Open {
    fs::path canonical;
    fs::path shown;
  };

  void read_file(const TomlValue& name) {
    DiagnosticList& diagnostics = context_.diagnostics;
    const auto found = context_.files.find(name, name.spot.file, diagnostics);
    if (!found) return;
    const auto same = [&](const Open& o) { return o.canonical == found->canonical; };
    if (const auto first = std::find_if(open_.begin(), open_.end(), same); first != open_.end()) {
      std::string path;
      for (auto file = first; file != open_.end(); ++file) path += "`" + file->shown.string() + "` -> ";
      diagnostics.error(name.spot, "files include each other in a circle: " + path + "`" + first->shown.string() + "`");
      return;
    }
    if (!done_.insert(found->canonical).second) return;
    if (open_.size() > most_including) {
      diagnostics.error(name.spot, "files include each other more than " + std::to_string(most_including) + " levels deep");
      return;
    }
    const auto file = context_.files.read(*found, Sources::Role::included, name.spot, diagnostics);
    if (!file) return;
    auto document = context_.files.document(*file, diagnostics);
    if (!document) return;
    open_.push_back({found->canonical, found->shown});
    read(document->value());
    open_.pop_back();
    refuse_others(document->value());
    files.push_back({*file, std::move(*document)});
  }

  void refuse_others(const TomlValue& document) {
    TableReader reader(document, "an included file");
    for (const char* key : {"models", "laws", "parameters", "include", "title"}) reader.find(key);
    for (const char* key : {"domain", "elements", "nodes", "simulate"})
      if (const TomlEntry* entry = reader.find_quietly(key))
        context_.diagnostics.error(entry->spot, "an included file cannot have `" + std::string(key) + "`",
                                "it gives models: it may have `models`, `laws`, `parameters`, `include` and `title`");
    reader.finish(context_.diagnostics);
  }

  Context& context_;
  std::vector<Open> open_;  ///< the file being read and the files that include it
  std::set<fs::path> done_;
};

}  // namespace

std::deque<IncludedFile> read_includes(const TomlValue& document, const fs::path& main, Context& context) {
  Includer includer(context, main);
  includer.read(document);
  return std::move(includer.files);
}

}  // namespace rheonet
