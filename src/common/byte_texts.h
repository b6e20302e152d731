#pragma once

#include <string>
#include <string_view>

/// Names and titles are bytes, of files by no encoding at all: they are kept as they are, and
/// written as a format can have them.
namespace pounding {

/// A text in UTF-8: bytes that are none are taken as letters of Latin-1.
std::string readable(std::string_view bytes);

/// Bytes that are no UTF-8 as letters of a private area (U+F780 and above), and back.
std::string with_marked_bytes(std::string_view bytes);
std::string with_plain_bytes(std::string_view marked);

/// A text in one line without control characters, which a terminal would obey: blanks for them.
std::string one_line(std::string text);

}  // namespace pounding
