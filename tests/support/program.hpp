#pragma once

#include <filesystem>
#include <string>

namespace rheonet::test {

/// The result of a process.
struct Finished {
  int status = 0;  ///< Exit status; 128 + n if signal n ended the process.
  std::string out;
  std::string err;
};

/// An empty folder, which is removed with its contents at the end of the test.
class Folder {
 public:
  Folder();
  explicit Folder(const std::string& scene);  ///< with this netlist in it, `scene.toml`
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  /// Writes a file, making the folders that its name needs. Its path.
  std::filesystem::path write(const std::string& name, const std::string& text) const;
  std::string read(const std::string& name) const;  ///< "" if there is no such file
  bool has(const std::string& name) const { return std::filesystem::exists(path_ / name); }

  /// Runs a shell command in the folder; `rheonet` in it is the program just built.
  Finished shell(const std::string& command) const;
  /// The same with an expected exit status: for any other status the test fails with the output of the command.
  Finished shell(const std::string& command, int expected_status) const;

 private:
  std::filesystem::path path_;
};

inline bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// The whole text of a file; fails the test if it cannot be read.
std::string text_of(const std::filesystem::path& file);

}  // namespace rheonet::test
