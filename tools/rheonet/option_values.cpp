#include "tools/rheonet/option_values.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <utility>

#include "tools/rheonet/words.hpp"

namespace rheonet::tool {

double read_number(const char* option, const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) {
    throw WrongCommandLine{fmt::format("`{}` takes a number such as 1e-6, not `{}`", option, text), ""};
  }
  return value;
}

int read_whole(const char* option, const std::string& text, int least, int most) {
  const double value = read_number(option, text);
  if (value >= least && value <= most && value == std::floor(value)) return static_cast<int>(value);
  throw WrongCommandLine{fmt::format("`{}` takes a whole number from {} to {}, not `{}`", option, least, most, text), ""};
}

void add_list(CLI::App* command, const char* names, std::vector<std::string>& values, const char* description,
              const char* type, bool commas) {
  const auto take = [&values, commas](const std::vector<std::string>& given) {
    for (const std::string& text : given)
      for (std::string& part : commas ? split_outside_brackets(text) : std::vector<std::string>{text})
        values.push_back(std::move(part));
  };
  command->add_option_function<std::vector<std::string>>(names, take, description)
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
      ->allow_extra_args(false)
      ->type_name(type);
}

}  // namespace rheonet::tool
