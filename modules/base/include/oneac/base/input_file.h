#pragma once

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <string>

namespace oneac {

/// What keeps a path from being read as a file: "no such file", "is a folder", "is a pipe, …", or
/// the system's reason; "" for a regular file and for a link to one. Opens nothing: a pipe without
/// a writer would hold the program.
[[nodiscard]] std::string fault_of_file(const std::filesystem::path& path);

/// What keeps a file from being written to a path, as of fault_of_file(); "" also where there is
/// nothing yet.
[[nodiscard]] std::string fault_of_place(const std::filesystem::path& path);

/// Whether two paths lead to one file or folder, by whatever way: links, dots, another spelling.
/// Where nothing is there, whether they are spelled alike.
[[nodiscard]] bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// The first bytes of a file, fewer where it is shorter, none where it is no file.
[[nodiscard]] std::string beginning_of(const std::filesystem::path& path, std::size_t bytes);

/// Opens a file for reading, byte by byte.
/// @param cure  what the user can do when it is not there or no file
/// @throws InputError naming the path and fault_of_file(), or that it cannot be opened
[[nodiscard]] std::ifstream open_input(const std::filesystem::path& path, const std::string& cure);

/// Takes the mark away that some editors put before a text.
void drop_byte_order_mark(std::string& text);

/// A number that stands for the content of a file (64 bits in hexadecimal), for telling builds
/// apart, not against forgery; "" when the file cannot be read.
[[nodiscard]] std::string content_hash(const std::filesystem::path& path);

/// A file that came with the running program: beside it, or in ../lib/oneac from there; "" where it
/// is in neither.
[[nodiscard]] std::filesystem::path file_of_program(const std::string& name);

}  // namespace oneac
