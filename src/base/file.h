#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace relamp
{

/// The whole content of a regular file. Throws Error(cannotRead) with the reason: missing, a
/// directory, a device, empty, no permission, or more than `largest` bytes.
std::vector<std::byte> readFile(const std::filesystem::path& file,
                                size_t largest = size_t{4} << 30);

/// Writes a file that must not exist yet or may be replaced. Throws Error(cannotWrite) with the
/// system's reason (no space, no permission).
void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes);
void writeFile(const std::filesystem::path& file, const std::string& text);

/// Makes an empty file, which everyone may read, or an empty folder of a hidden name beside
/// `target`, for what will take that place when it is complete. Its name tells the process; what
/// processes of this machine that are no more have left there goes. Throws Error(cannotWrite).
std::filesystem::path stageFile(const std::filesystem::path& target);
std::filesystem::path stageFolder(const std::filesystem::path& target);

/// Writes a file beside its place and moves it there when it is complete: whoever reads it finds
/// the old one or the new one. Throws Error(cannotWrite).
void replaceFile(const std::filesystem::path& file, std::span<const std::byte> bytes);

} // namespace relamp
