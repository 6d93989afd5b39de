#pragma once

#include <string>
#include <string_view>

namespace rheonet::tool {

/// Atomic replacement of a file. The new text is written to a temporary file in the same folder, which is renamed only when it is complete
/// and on disk. So a full disk, a crash or an interrupt leaves the old file or none, never a part of the new one. Mode and owner of the old
/// file are kept; a new file gets its mode from the umask.
class Replacement {
 public:
  /// `name` is an entry of the folder with descriptor `folder`, not a path; a symbolic link is replaced, never followed. The descriptor
  /// must stay open. Throws std::system_error if no file can be created in the folder.
  Replacement(int folder, std::string name);
  /// Removes the temporary file unless it has been committed.
  ~Replacement();
  Replacement(const Replacement&) = delete;
  Replacement& operator=(const Replacement&) = delete;

  /// The descriptor to write to.
  int descriptor() const { return descriptor_; }
  /// Replaces the file durably: the new text survives a crash of the machine. Returns the error (errno) or 0.
  int commit();

 private:
  int folder_;
  std::string name_, temporary_;
  int descriptor_ = -1;
  bool committed_ = false;
};

/// Writes all of a text. Returns the error (errno) or 0.
int write_text(int descriptor, std::string_view text);

}  // namespace rheonet::tool
