#include "tools/rheonet/asked_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/comparison.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// What one `--variant` says: a scene, values of it, or both.
struct Asked {
  std::string text, file;
  std::vector<std::string> overrides;
};

std::optional<Asked> parsed(const std::string& text, const std::string& own_file) {
  Asked asked{trimmed(text), own_file, {}};
  for (const std::string& part : split(asked.text, ';')) {
    const std::string word = trimmed(part);
    if (asked.overrides.empty() && asked.file == own_file && word.ends_with(".toml") && word.find('=') == std::string::npos) {
      asked.file = word;
    } else if (word.find('=') != std::string::npos) {
      asked.overrides.push_back(word);
    } else {
      say("error: `--variant {}`: `{}` is neither a scene nor a value\n  --variant \"other.toml; k1.stiffness=300 N/m\"\n", printable(text),
          printable(word));
      return {};
    }
  }
  return asked;
}

/// `--pair a=b`: what the scene records as a the variants have as b.
std::optional<std::map<std::string, std::string>> pairs_of(const Arguments& arguments, const Scene& scene) {
  const Columns known = record_columns(scene);
  std::map<std::string, std::string> result;
  for (const std::string& text : arguments.pairs) {
    const std::vector<std::string> paths = split(text, '=');
    if (paths.size() != 2) {
      say("error: `--pair {}` names {} records, not two\n  --pair k1.force=m.spring1.force\n", printable(text), paths.size());
      return {};
    }
    if (!known.contains(paths[0])) {
      say("error: `--pair {}`: the scene does not record `{}`\n", printable(text), printable(paths[0]));
      return {};
    }
    result[paths[0]] = paths[1];
  }
  return result;
}

/// In the order of the records of the scene; false, with a message, where a quantity is another one.
bool take_records(const Scene& scene, const std::vector<std::string>& paths, const std::string& text, Scene& variant) {
  const Columns columns = record_columns(variant);
  std::vector<Record> records;
  for (std::size_t k = 0; k < paths.size(); ++k) {
    const Record& record = variant.records[columns.at(paths[k])];
    if (!unit_of(scene, scene.records[k]).dimension.same(unit_of(variant, record).dimension)) {
      say("error: `{}` and, in the variant `{}`, `{}` are different quantities\n", scene.records[k].path, printable(text), paths[k]);
      return false;
    }
    records.push_back(record);
  }
  variant.records = std::move(records);
  variant.exact.clear();
  return true;
}

}  // namespace

std::optional<std::vector<SimulationMethod>> asked_variants(const Arguments& arguments, Scene& scene) {
  const auto pairs = pairs_of(arguments, scene);
  if (!pairs) return {};
  std::vector<std::string> own, paired;  // paths, in this scene and in others
  for (const Record& record : scene.records) {
    const auto other = pairs->find(record.path);
    own.push_back(record.path);
    paired.push_back(other == pairs->end() ? record.path : other->second);
  }
  std::vector<SimulationMethod> methods;
  std::vector<Scene> scenes{scene};
  for (const std::string& text : arguments.variant_texts) {
    const auto asked = parsed(text, arguments.scene);
    if (!asked) return {};
    ReadOptions options = options_of(arguments);
    options.claims = false;  // they are about each scene as it stands, alone
    const std::vector<std::string>& paths = asked->file == arguments.scene ? own : paired;
    options.records = paths;
    options.overrides.insert(options.overrides.end(), asked->overrides.begin(), asked->overrides.end());
    ReadResult read = read_and_report(asked->file, options);
    if (!read.scene || !take_records(scene, paths, text, *read.scene)) {
      say("  in the variant `{}`; it has to have all that the scene records, or what `--pair` names in place of it\n", printable(text));
      return {};
    }
    methods.push_back({.name = asked->text});
    scenes.push_back(std::move(*read.scene));
  }
  if (const std::string why = obstacle(scenes); !why.empty()) {
    say("error: {}\n", why);
    return {};
  }
  if (!methods.empty()) to_one_time_base(scenes);
  scene = scenes.front();
  for (std::size_t k = 0; k < methods.size(); ++k) methods[k].scene = {std::move(scenes[k + 1])};
  return methods;
}

}  // namespace rheonet::tool
