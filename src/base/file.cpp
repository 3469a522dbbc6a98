#include "base/file.h"

#include "base/hash.h"
#include "relamp/error.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string_view>
#include <system_error>

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

// Behind a name; behind that, the machine that a process is on, its id, and six letters.
constexpr std::string_view kStaged = ".relamp-";
constexpr size_t kLetters = 6;

/// Where process ids mean the same: a machine, and on it a container.
std::string placeOfProcesses()
{
    std::array<char, 256> host{};
    gethostname(host.data(), host.size() - 1);
    std::error_code ignored;
    Hash hash;
    const auto add = [&](const std::string& text) {
        hash.addBytes(std::as_bytes(std::span(text)));
    };
    add(host.data());
    add(std::filesystem::read_symlink("/proc/self/ns/pid", ignored).string());
    return fmt::format("{:08x}", hash.value() >> 32);
}

/// What the names of all that stands in for `target` begin with.
std::string prefixFor(const std::filesystem::path& target)
{
    return fmt::format(".{}{}", target.filename().string(), kStaged);
}

/// The process that stands behind "machine-id-letters", if it was of this machine and is no more.
bool isOfTheDead(std::string_view behindPrefix)
{
    const std::string here = placeOfProcesses() + "-";
    if (!behindPrefix.starts_with(here)) return false;
    behindPrefix.remove_prefix(here.size());
    pid_t process = 0;
    const char* last = behindPrefix.data() + behindPrefix.size();
    const auto [end, error] = std::from_chars(behindPrefix.data(), last, process);
    if (error != std::errc() || process <= 0 || static_cast<size_t>(last - end) != kLetters + 1 ||
        *end != '-')
        return false;
    return kill(process, 0) != 0 && errno == ESRCH;
}

/// What processes that were killed have left behind for `target`.
void removeAbandoned(const std::filesystem::path& target)
{
    const std::string prefix = prefixFor(target);
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::error_code ignored;
    std::vector<std::filesystem::path> abandoned;
    for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(prefix) && isOfTheDead(std::string_view(name).substr(prefix.size())))
            abandoned.push_back(entry.path());
    }
    for (const std::filesystem::path& path : abandoned) std::filesystem::remove_all(path, ignored);
}

/// For mkstemp and mkdtemp.
std::string patternBeside(const std::filesystem::path& target)
{
    removeAbandoned(target);
    return (target.parent_path() /
            fmt::format("{}{}-{}-XXXXXX", prefixFor(target), placeOfProcesses(), getpid()))
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
            mark != std::string::npos && name[0] == '.' &&
            std::count(name.begin() + static_cast<std::ptrdiff_t>(mark + kStaged.size()),
                       name.end(), '-') == 2;
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
