#include "tests/support/program.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <system_error>

namespace rheonet::test {

namespace fs = std::filesystem;

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "rheonet-test-XXXXXX").string();
  if (::mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), pattern);
  path_ = pattern;
}

Folder::Folder(const std::string& scene) : Folder() { write("scene.toml", scene); }

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path Folder::write(const std::string& name, const std::string& text) const {
  const fs::path file = path_ / name;
  fs::create_directories(file.parent_path());
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

std::string Folder::read(const std::string& name) const { return has(name) ? text_of(path_ / name) : ""; }

Finished Folder::shell(const std::string& command) const {
  // Outside the folder, so that a command finds there only what the test put there.
  const fs::path out = path_.string() + ".out";
  const fs::path err = path_.string() + ".err";
  const fs::path script = path_.string() + ".sh";
  std::ofstream(script) << "cd '" << path_.string() << "' && PATH='" << fs::path(RHEONET_PROGRAM).parent_path().string()
                        << "':\"$PATH\"\n"
                        << command << "\n";
  const std::string line = "bash '" + script.string() + "' >'" + out.string() + "' 2>'" + err.string() + "' </dev/null";
  const int raw = std::system(line.c_str());
  Finished result;
  result.status = WIFEXITED(raw) ? WEXITSTATUS(raw) : 128 + WTERMSIG(raw);
  result.out = text_of(out);
  result.err = text_of(err);
  for (const fs::path& file : {out, err, script}) fs::remove(file);
  return result;
}

Finished Folder::shell(const std::string& command, int expected_status) const {
  Finished result = shell(command);
  CHECK_MESSAGE(result.status == expected_status, result.err);
  return result;
}

std::string text_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  REQUIRE_MESSAGE(in, "cannot read " << file.string());
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace rheonet::test
