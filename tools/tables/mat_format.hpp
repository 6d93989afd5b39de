#pragma once

#include <cstddef>
#include <cstdint>

/// The parts of a MAT file of level 5. Source: MathWorks, "MAT-File Format", chapter "Level 5 MAT-File Format".
namespace rheonet::tables::mat {

/// A file begins with a header: 124 bytes of text, then the version and the byte order, of two bytes each.
constexpr std::size_t header_size = 128, header_text_size = 124;
constexpr std::uint16_t version = 0x0100, byte_order = ('M' << 8) | 'I';  ///< A reader sees "IM" if the bytes have to be swapped.
constexpr char header_text[] = "MATLAB 5.0 MAT-file, created by ";        ///< of rheonet's own files; the name of the program follows

/// Data elements follow: a tag (type, size in bytes), and data padded to 8 bytes. An element of 4 bytes or fewer may have its size in the
/// upper half of the word with its type, and its data in the next word.
constexpr std::size_t tag_size = 8;
enum class Type : std::uint32_t { int8 = 1, uint8, int16, uint16, int32, uint32, float32, float64 = 9, int64 = 12, uint64, matrix, compressed, utf8, utf16 };

/// A matrix consists of elements: flags, of which the lowest byte is the class; size; name; data.
enum class Class : std::uint32_t { cell = 1, structure, object, text, sparse, float64, float32, int8, uint8, int16, uint16, int32, uint32, int64, uint64, function, opaque };
constexpr std::uint32_t is_complex = 0x0800;  ///< flag: the imaginary part follows

}  // namespace rheonet::tables::mat
