#pragma once

#include <filesystem>
#include <string>

/// All of a file of text. Throws relamp::Error(cannotRead), also where it is longer than 16 MiB.
std::string textFrom(const std::filesystem::path& file);

/// Writes a file whole or not at all. Throws relamp::Error(cannotWrite).
void writeText(const std::filesystem::path& file, const std::string& text);
