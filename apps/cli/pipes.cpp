#include "pipes.h"

#include "relamp/error.h"

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <system_error>

#include <fmt/format.h>

namespace
{

constexpr size_t kChunk = size_t{1} << 16; // bytes

std::filesystem::path newFolder()
{
    std::error_code error; // and then TMPDIR, which is no folder, is what mkdtemp fails in
    std::filesystem::path parent = std::filesystem::temp_directory_path(error);
    if (error) parent = std::getenv("TMPDIR");
    std::string name = (parent / "relamp-XXXXXX").string();
    if (mkdtemp(name.data()) != nullptr) return name;
    throw relamp::Error(relamp::ErrorCode::cannotWrite,
                        fmt::format("{}: cannot be made: {}; name a folder that can be written in "
                                    "TMPDIR",
                                    name, std::strerror(errno)));
}

} // namespace

std::string readPiped(size_t largest)
{
    std::string text;
    std::array<char, kChunk> chunk{};
    while (const size_t count = std::fread(chunk.data(), 1, chunk.size(), stdin)) {
        text.append(chunk.data(), count);
        if (text.size() > largest)
            throw relamp::Error(relamp::ErrorCode::cannotRead,
                                fmt::format("-: standard input is longer than {} bytes", largest));
    }
    if (text.empty())
        throw relamp::Error(relamp::ErrorCode::cannotRead,
                            "-: nothing came on standard input; pipe a file into it, or name one");
    return text;
}

PipedFile::PipedFile(const std::string& ending)
    : folder_(newFolder()), file_(folder_ / ("piped" + ending))
{}

PipedFile::~PipedFile()
{
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
}

void PipedFile::send() const
{
    std::ifstream file(file_, std::ios::binary);
    std::array<char, kChunk> chunk{};
    bool isTaken = true;
    while (isTaken && (file.read(chunk.data(), chunk.size()), file.gcount() > 0)) {
        const auto count = static_cast<size_t>(file.gcount());
        isTaken = std::fwrite(chunk.data(), 1, count, stdout) == count;
    }
    if (!isTaken || std::fflush(stdout) != 0)
        throw relamp::Error(relamp::ErrorCode::cannotWrite,
                            fmt::format("-: standard output: {}", std::strerror(errno)));
}
