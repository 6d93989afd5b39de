#include "tools/rheonet/asked_variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/netlist/characters.hpp"
#include "tools/rheonet/comparison.hpp"
#include "tools/rheonet/pricing.hpp"
#include "tools/rheonet/reading.hpp"
#include "tools/rheonet/say.hpp"
#include "tools/rheonet/words.hpp"

namespace rheonet::tool {
namespace {

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t"), last = text.find_last_not_of(" \t");
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

/// The contents of one `--variant`: a scene, values, or both.
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

/// `--pair a=b`: record `a` of the scene corresponds to record `b` of the variants.
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

/// Reads a variant, with the records `own` if it comes from the scene's own file, otherwise with the records `paired`. Returns nothing,
/// after messages, if it has a mistake. Throws NotComparable.
std::optional<Variant> read_variant(const Arguments& arguments, const std::string& text, const std::vector<std::string>& own,
                                    const std::vector<std::string>& paired, const Scene& scene) {
  const auto asked = parsed(text, arguments.scene);
  if (!asked) return {};
  ReadOptions options = options_of(arguments);
  options.claims = false;  // Claims hold for the unmodified scene.
  options.records = asked->file == arguments.scene ? own : paired;
  options.overrides.insert(options.overrides.end(), asked->overrides.begin(), asked->overrides.end());
  ReadResult read = read_and_report(asked->file, options);
  if (!read.scene) {
    say("  in the variant `{}`; it has to have all that the scene records, or what `--pair` names in place of it\n", printable(text));
    return {};
  }
  Variant variant{asked->text, std::move(*read.scene)};
  take_records(scene, options.records, variant);
  return variant;
}

}  // namespace

std::optional<std::vector<SimulationMethod>> asked_variants(const Arguments& arguments, Scene& scene) {
  const auto pairs = pairs_of(arguments, scene);
  if (!pairs) return {};
  std::vector<std::string> own, paired;  // Paths in this scene and in other scenes.
  for (const Record& record : scene.records) {
    const auto other = pairs->find(record.path);
    own.push_back(record.path);
    paired.push_back(other == pairs->end() ? record.path : other->second);
  }
  try {
    std::vector<Variant> variants;
    for (const std::string& text : arguments.variant_texts) {
      std::optional<Variant> variant = read_variant(arguments, text, own, paired, scene);
      if (!variant) return {};
      variants.push_back(std::move(*variant));
    }
    return methods_of(std::move(variants), scene);
  } catch (const NotComparable& why) {
    say("error: {}\n", printable(why.what()));
    return {};
  }
}

}  // namespace rheonet::tool
