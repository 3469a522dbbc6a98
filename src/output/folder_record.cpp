#include "output/folder_record.h"

#include "base/fail.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/json.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstdio>
#include <cstring>
#include <memory>
#include <vector>

namespace relamp
{
namespace fs = std::filesystem;
namespace
{

using nlohmann::json;
using nlohmann::ordered_json;

constexpr size_t kLargestList = size_t{16} << 20; // bytes
constexpr size_t kChunk = size_t{1} << 20;        // bytes that are hashed at a time
constexpr size_t kMostNamed = 6;                  // in a sentence

struct CloseFile
{
    void operator()(std::FILE* file) const { std::fclose(file); }
};

/// None where `folder` has no such file, or it is not relamp's.
std::optional<json> readLister(const fs::path& folder, const std::string& lister)
{
    try {
        const auto bytes = readFile(folder / lister, kLargestList);
        json document =
            parseJson({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, lister);
        const auto program = document.is_object() ? document.value("program", json()) : json();
        if (!program.is_string() || !program.get<std::string>().starts_with("relamp ")) return {};
        return document;
    } catch (const Error&) {
        return {};
    }
}

std::string listed(const std::vector<std::string>& names)
{
    std::string list;
    for (size_t i = 0; i < std::min(names.size(), kMostNamed); ++i)
        list += (i == 0 ? "" : ", ") + names[i];
    if (names.size() > kMostNamed) list += fmt::format(" and {} more", names.size() - kMostNamed);
    return list;
}

} // namespace

FileMark markOf(const fs::path& file)
{
    const std::unique_ptr<std::FILE, CloseFile> stream(std::fopen(file.c_str(), "rb"));
    if (!stream) fail(ErrorCode::cannotRead, file.string(), std::strerror(errno));
    FileMark mark;
    Hash hash;
    std::vector<std::byte> chunk(kChunk);
    size_t count = 0;
    do {
        count = std::fread(chunk.data(), 1, chunk.size(), stream.get());
        hash.addBytes(std::span(chunk).first(count));
        mark.bytes += count;
    } while (count == chunk.size());
    if (std::ferror(stream.get()) != 0)
        fail(ErrorCode::cannotRead, file.string(), "could not be read to its end");
    mark.hash = hash.value();
    return mark;
}

ordered_json asJson(const FileMark& mark)
{
    return {{"bytes", mark.bytes}, {"checksum", fmt::format("{:016x}", mark.hash)}};
}

std::optional<FileMark> markFrom(const json& object)
{
    const json bytes = object.value("bytes", json());
    const json checksum = object.value("checksum", json());
    if (!bytes.is_number_unsigned() || !checksum.is_string()) return {};
    const auto digits = checksum.get<std::string>();
    FileMark mark{.bytes = bytes.get<uint64_t>()};
    const char* last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, mark.hash, 16);
    if (error != std::errc() || end != last) return {};
    return mark;
}

std::string inWords(const FileMark& mark)
{
    return fmt::format("{} bytes, checksum {:016x}", mark.bytes, mark.hash);
}

FolderRecord::FolderRecord(const fs::path& folder, const std::string& lister)
{
    for (const auto& entry : fs::directory_iterator(folder))
        marks_[entry.path().filename()] = markOf(entry.path());
    marks_[lister].reset();
}

FolderRecord FolderRecord::read(const fs::path& folder, const std::string& lister)
{
    FolderRecord record;
    const std::optional<json> document = readLister(folder, lister);
    if (!document) return record;
    const json files = document->value("files", json::array());
    for (const json& file : files) {
        if (!file.is_object() || !file.value("name", json()).is_string()) continue;
        const auto name = file["name"].get<std::string>();
        const auto mark = markFrom(file);
        if (name == fs::path(name).filename() && mark) record.marks_[name] = mark;
    }
    record.marks_[lister].reset();
    return record;
}

ordered_json FolderRecord::asJson() const
{
    ordered_json files = ordered_json::array();
    for (const auto& [name, mark] : marks_) {
        ordered_json file{{"name", name}};
        if (mark) file.update(relamp::asJson(*mark));
        files.push_back(std::move(file));
    }
    return files;
}

std::vector<std::string> FolderRecord::names() const
{
    std::vector<std::string> names;
    for (const auto& [name, mark] : marks_) names.push_back(name);
    return names;
}

bool FolderRecord::isAsWritten(const fs::path& folder, const std::string& name) const
{
    const auto found = marks_.find(name);
    if (found == marks_.end()) return false;
    if (!found->second) return true;
    std::error_code failure;
    const fs::path file = folder / name;
    return fs::is_regular_file(file, failure) &&
           fs::file_size(file, failure) == found->second->bytes && markOf(file) == *found->second;
}

void checkReplaceable(const fs::path& folder, const FolderRecord& record,
                      const std::function<bool(const std::string& name)>& writes)
{
    std::vector<std::string> kept;
    std::error_code failure;
    for (const auto& entry : fs::directory_iterator(folder, failure)) {
        const std::string name = entry.path().filename();
        if ((record.lists(name) || writes(name)) && !record.isAsWritten(folder, name))
            kept.push_back(name);
    }
    if (kept.empty()) return;
    std::sort(kept.begin(), kept.end());
    fail(ErrorCode::cannotWrite, folder.string(),
         fmt::format("would lose what relamp did not write, or what was changed since: {}. Name "
                     "another folder with -o, keep a copy elsewhere, or replace it with --force",
                     listed(kept)));
}

} // namespace relamp
