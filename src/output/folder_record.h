#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace relamp
{

/// What tells a file from another of its name, but for forgery.
struct FileMark
{
    uint64_t bytes = 0;
    uint64_t hash = 0;

    bool operator==(const FileMark&) const = default;
};

/// Reads the whole file. Throws Error(cannotRead).
FileMark markOf(const std::filesystem::path& file);

/// As `"bytes"` and `"checksum"`, sixteen hexadecimal digits.
nlohmann::ordered_json asJson(const FileMark& mark);
/// None where `object` has no such keys.
std::optional<FileMark> markFrom(const nlohmann::json& object);

/// "1234 bytes, checksum 0123456789abcdef".
std::string inWords(const FileMark& mark);

/// The files that relamp has put into a folder, as they were then. A JSON file of the folder, which
/// relamp puts there as well, lists them.
class FolderRecord
{
public:
    FolderRecord() = default;
    /// Of what lies in `folder` now, and of `lister`, which will hold the list.
    FolderRecord(const std::filesystem::path& folder, const std::string& lister);

    /// What `lister` says; where it is not there or not relamp's, nothing is relamp's.
    static FolderRecord read(const std::filesystem::path& folder, const std::string& lister);

    /// The value of `"files"` in `lister`.
    [[nodiscard]] nlohmann::ordered_json asJson() const;
    [[nodiscard]] bool lists(const std::string& name) const { return marks_.contains(name); }
    [[nodiscard]] std::vector<std::string> names() const;
    /// Whether a file of the folder is as relamp left it.
    [[nodiscard]] bool isAsWritten(const std::filesystem::path& folder,
                                   const std::string& name) const;

private:
    std::map<std::string, std::optional<FileMark>> marks_; // none: of `lister` itself
};

/// Throws Error(cannotWrite) naming what lies in `folder`, would be replaced or removed by what
/// writes anew the files of the record and those that `writes(name)` tells of, and is not as relamp
/// left it.
void checkReplaceable(const std::filesystem::path& folder, const FolderRecord& record,
                      const std::function<bool(const std::string& name)>& writes);

} // namespace relamp
