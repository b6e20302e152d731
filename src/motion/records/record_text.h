#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pounding {

/// A line of a text file, without its end and its trailing blanks; `number` counts from 1.
struct TextLine {
  int number = 0;
  std::string text;
};

/// A row of numbers; `delimited` when commas or semicolons separate them.
struct NumberRow {
  int line = 0;
  std::vector<double> values;
  bool delimited = false;
  int decimals = 0;  ///< digits behind the points of all of them; -1 where these differ
};

/// Lines of a file for Unix, Windows (also CR CR LF) or old Mac line ends, without byte-order mark.
/// Throws UserError when the file cannot be read, is empty, is not text, or has no end.
std::vector<TextLine> read_text_lines(const std::string& file);

/// True for comments and decorations: lines that begin with % ; # ! or *.
bool is_comment(std::string_view text);

/// A number in the spellings of C and Fortran (.5  1.  +2  1.5D-02); nothing if `word` is anything
/// else, infinite or not a number.
std::optional<double> parse_number(std::string_view word);

/// Words of a line, separated by commas, else by semicolons, else by blanks.
std::vector<std::string_view> split_words(std::string_view text);

/// The numbers of a line of which every word is one, or whose fixed-width values touch; else
/// nothing.
std::optional<NumberRow> parse_row(const TextLine& line);

/// The first word of a line that is not a finite number.
std::string first_bad_word(std::string_view text);

/// A number as messages show it.
std::string text_of(double value);

/// "file:line: "
std::string at_line(const std::string& file, int line);

/// Writes the numbers of a record with decimal points where they have decimal commas: one column
/// (0,25), or several that semicolons, blanks or tabs separate (0,02;-0,25). A single comma per
/// line may also separate two columns of whole numbers: decimals that begin with a zero, "-0" and
/// the like decide, then names with a comma between them, a `column` that is asked for, and first
/// numbers that increase. Returns whether commas were decimal. Throws UserError when nothing
/// decides.
bool replace_decimal_commas(const std::string& file, int column, std::vector<TextLine>& lines);

}  // namespace pounding
