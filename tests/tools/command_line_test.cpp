#include <doctest/doctest.h>

#include "tests/support/program.hpp"
#include "tests/tools/scenes.hpp"

namespace rheonet::test::command_line_test {

TEST_CASE("help and version go to standard output with status 0") {
  const Folder folder;
  for (const std::string words :
       {"--help", "-h", "run --help", "check --help", "compare --help", "components --help", "schema --help", "draw --help"}) {
    CAPTURE(words);
    const Finished help = folder.shell(std::string("rheonet ") + words);
    CHECK(help.status == 0);
    CHECK(contains(help.out, "Usage: rheonet"));
    CHECK(help.err == "");
  }
  for (const std::string words : {"run --help", "check --help", "compare --help"}) {
    CHECK(contains(folder.shell(std::string("rheonet ") + words).out, "Exit status"));
  }
  for (const std::string option : {"--set", "--accuracy", "--output", "--quiet"}) {
    CHECK(contains(folder.shell("rheonet run --help").out, option));
  }
  const Finished version = folder.shell("rheonet --version");
  CHECK(version.status == 0);
  CHECK(version.out == "rheonet 0.1.0\n");
}

TEST_CASE("a wrong command line has status 2, an empty standard output, and says what would mend it") {
  struct Case {
    std::string words;
    std::string message;
    std::string hint;
  };
  const Case cases[] = {
      {"", "no command given", "rheonet run SCENE"},
      {"rnu scene.toml", "unknown command `rnu`", "did you mean `run`?"},
      {"simulate scene.toml", "unknown command `simulate`", "did you mean `run`?"},
      {"validate", "unknown command `validate`", "did you mean `check`?"},
      {"schemata", "unknown command `schemata`", "did you mean `schema`?"},
      {"scene.toml", "unknown command `scene.toml`", "`rheonet run scene.toml`"},
      {"--verison", "unknown option `--verison`", "did you mean `--version`?"},
      {"run", "SCENE is required", "`rheonet run --help`"},
      {"run scene.toml --acuracy 1e-3", "unknown option `--acuracy`", "did you mean `--accuracy`?"},
      {"run --quite scene.toml", "unknown option `--quite`", "did you mean `--quiet`?"},
      {"run scene.toml --ouput=out.csv", "unknown option `--ouput`", "did you mean `--output`?"},
      {"run scene.toml -z", "unknown option `-z`", "`rheonet run --help`"},
      {"run scene.toml other.toml", "unexpected argument `other.toml`", "`rheonet run --help`"},
      {"run scene.toml --set k1.stiffness=40 N/m", "unexpected argument `N/m`", "in quotes: --set 'PATH=VALUE UNIT'"},
      {"check --set=k1.stiffness=40 scene.toml N/m", "unexpected argument `N/m`", "`rheonet check --help`"},
      {"run scene.toml --set simulate.stop=1 k1.stiffness=40 N/m", "unexpected argument `N/m`", "in quotes: --set"},
      {"run scene.toml --accuracy much", "`--accuracy` takes a number such as 1e-6, not `much`", ""},
      {"run scene.toml --accuracy 1e-3x", "`--accuracy` takes a number such as 1e-6, not `1e-3x`", ""},
      {"run scene.toml --accuracy ''", "`--accuracy` takes a number such as 1e-6, not ``", ""},
      {"run scene.toml --accuracy", "`--accuracy` needs a value", "`rheonet run --help`"},
      {"run scene.toml -o", "`--output` needs a value", ""},
      {"run scene.toml -o a.csv -o b.csv", "`--output` is given more than once", ""},
      {"check scene.toml run", "unexpected argument `run`", ""},
      {"check scene.toml -o out.csv", "unknown option `-o`", "`rheonet check --help`"},
      {"components spring mass", "unexpected argument `mass`", ""},
      {"components sprong", "unknown element type `sprong`", "did you mean `spring`?"},
      {"schema spring", "unexpected argument `spring`", ""},
  };
  const Folder folder(oscillator);
  folder.write("other.toml", oscillator);
  for (const Case& c : cases) {
    CAPTURE(c.words);
    const Finished result = folder.shell(std::string("rheonet ") + c.words);
    CHECK(result.status == 2);
    CHECK(result.out == "");
    CAPTURE(result.err);
    CHECK(result.err.starts_with("error: "));
    CHECK(contains(result.err, c.message));
    CHECK(contains(result.err, c.hint));
  }
}

TEST_CASE("--set takes one value or several, before the scene or after it") {
  const Folder folder(oscillator);
  const std::string plain = folder.shell("rheonet run -q scene.toml").out;
  const std::string expected =
      folder.shell("rheonet run -q scene.toml --set k1.stiffness='\"300 N/m\"' --set simulate.stop=0.5").out;
  CHECK(expected != plain);
  CHECK(contains(expected, "\n0.5,"));
  for (const std::string words : {"--set k1.stiffness='\"300 N/m\"' simulate.stop=0.5 scene.toml",
                                  "--set=k1.stiffness='\"300 N/m\"' --set=simulate.stop=0.5 scene.toml",
                                  "--set k1.stiffness='\"300 N/m\"' scene.toml --set simulate.stop=0.5",
                                  "--set k1.stiffness='300 N/m' simulate.stop='0.5 s' -- scene.toml"}) {
    CAPTURE(words);
    const Finished result = folder.shell(std::string("rheonet run -q ") + words);
    CHECK(result.status == 0);
    CHECK(result.out == expected);
  }
  const Finished wrong = folder.shell("rheonet run scene.toml --set k1.stifness=3");
  CHECK(wrong.status == 2);
  CHECK(contains(wrong.err, "stiffness"));
}

}  // namespace rheonet::test::command_line_test
