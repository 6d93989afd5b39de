#pragma once

#include <string>
#include <string_view>

namespace rheonet::tool {

/// A new text for a file. It is written to a temporary file in the same folder, which takes the name of the old file only
/// when it is complete and on disk. So a full disk, a crash or an interrupt leaves the old file, or none, never a part of the
/// new one. Mode and owner of the old file are kept; a new file gets the mode that the umask leaves.
class Replacement {
 public:
  /// `name` is an entry of the folder that `folder` is open on: no path, and a symbolic link is replaced, never followed. The
  /// folder must stay open. Throws std::system_error if it takes no new file.
  Replacement(int folder, std::string name);
  /// Removes the temporary file unless it has been committed.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// Where to write to.
  int descriptor() const { return descriptor_; }
  /// Puts the text in place, so that it survives a crash of the machine. The error (errno), 0 if it is done.
  int commit();

 private:
  int folder_;
  std::string name_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Writes all of a text. The error (errno), 0 if it is done.
int write_text(int descriptor, std::string_view text);

}  // namespace rheonet::tool
