#include "base/file.h"

#include "relamp/error.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

namespace relamp
{
namespace
{

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using File = std::unique_ptr<std::FILE, CloseFile>;

[[noreturn]] void cannotRead(const std::filesystem::path& file, const std::string& why)
{
    throw Error(ErrorCode::cannotRead, fmt::format("{}: {}", file.string(), why));
}

constexpr std::string_view kStaged = ".relamp-"; // behind a name, and six letters behind that

/// For mkstemp and mkdtemp.
std::string patternBeside(const std::filesystem::path& target)
{
    return (target.parent_path() / fmt::format(".{}{}XXXXXX", target.filename().string(), kStaged))
        .string();
}

/// The place that a file is meant for, by which a person knows it, wherever it is written first.
std::filesystem::path targetOf(const std::filesystem::path& file)
{
    std::filesystem::path target;
    for (const std::filesystem::path& part : file) {
        const std::string name = part.string();
        const size_t mark = name.rfind(kStaged);
        const bool isStaged =
            mark != std::string::npos && name[0] == '.' && name.size() == mark + kStaged.size() + 6;
        target /= isStaged ? name.substr(1, mark - 1) : name;
    }
    return target;
}

[[noreturn]] void cannotWrite(const std::filesystem::path& file)
{
    const int reason = errno;
    throw Error(
        ErrorCode::cannotWrite,
        fmt::format("{}: cannot be written: {}", targetOf(file).string(), std::strerror(reason)));
}

} // namespace

std::vector<std::byte> readFile(const std::filesystem::path& file, size_t largest)
{
    std::error_code failure;
    const auto status = std::filesystem::status(file, failure);
    if (!std::filesystem::exists(status)) cannotRead(file, "no such file");
    if (std::filesystem::is_directory(status)) cannotRead(file, "is a directory, not a file");
    if (!std::filesystem::is_regular_file(status)) cannotRead(file, "is not a regular file");

    const auto size = std::filesystem::file_size(file, failure);
    if (failure) cannotRead(file, failure.message());
    if (size == 0) cannotRead(file, "is empty (0 bytes); copy it again");
    if (size > largest)
        cannotRead(file, fmt::format("is larger than the {} MiB that can be read", largest >> 20));

    const File stream(std::fopen(file.c_str(), "rb"));
    if (!stream) cannotRead(file, std::strerror(errno));
    std::vector<std::byte> bytes(size);
    if (std::fread(bytes.data(), 1, size, stream.get()) != size)
        cannotRead(file, "could not be read to its end");
    return bytes;
}

void writeFile(const std::filesystem::path& file, std::span<const std::byte> bytes)
{
    File stream(std::fopen(file.c_str(), "wb"));
    if (!stream) cannotWrite(file);
    if (std::fwrite(bytes.data(), 1, bytes.size(), stream.get()) != bytes.size()) cannotWrite(file);
    if (std::fclose(stream.release()) != 0) cannotWrite(file);
}

void writeFile(const std::filesystem::path& file, const std::string& text)
{
    writeFile(file, std::as_bytes(std::span(text)));
}

std::filesystem::path stageFile(const std::filesystem::path& target)
{
    std::string staged = patternBeside(target);
    const int descriptor = mkstemp(staged.data());
    if (descriptor < 0) cannotWrite(target);
    fchmod(descriptor, 0644);
    close(descriptor);
    return staged;
}

std::filesystem::path stageFolder(const std::filesystem::path& target)
{
    std::string staged = patternBeside(target);
    if (mkdtemp(staged.data()) == nullptr) cannotWrite(target);
    chmod(staged.c_str(), 0755);
    return staged;
}

void replaceFile(const std::filesystem::path& file, std::span<const std::byte> bytes)
{
    const std::filesystem::path staged = stageFile(file);
    std::error_code failure;
    try {
        writeFile(staged, bytes);
        std::filesystem::rename(staged, file, failure);
        if (failure)
            throw Error(ErrorCode::cannotWrite,
                        fmt::format("{}: cannot be written: {}", file.string(), failure.message()));
    } catch (...) {
        std::filesystem::remove(staged, failure);
        throw;
    }
}

} // namespace relamp
