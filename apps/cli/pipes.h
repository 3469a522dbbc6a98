#pragma once

#include <filesystem>
#include <string>

/// Whether a person means a pipe by the name of a file.
inline bool isPipe(const std::filesystem::path& file)
{
    return file == "-";
}

/// All of standard input, for a file named -. Throws Error(cannotRead) where there is nothing, or
/// more than `largest` bytes.
std::string readPiped(size_t largest);

/// Where to write what goes to standard output once it is complete: a file that goes with this.
class PipedFile
{
public:
    explicit PipedFile(const std::string& ending);
    ~PipedFile();
    PipedFile(const PipedFile&) = delete;
    PipedFile& operator=(const PipedFile&) = delete;

    [[nodiscard]] const std::filesystem::path& path() const { return file_; }
    /// Copies the file to standard output. Throws Error(cannotWrite) where nobody takes it.
    void send() const;

private:
    std::filesystem::path folder_;
    std::filesystem::path file_;
};
