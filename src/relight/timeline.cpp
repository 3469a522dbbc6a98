#include "relamp/timeline.h"

#include "lights/json_document.h"
#include "relight/relighting_file.h"

#include <algorithm>
#include <optional>
#include <set>

namespace relamp
{
namespace
{

using nlohmann::json;

constexpr const char* kFormat = "relamp timeline 1";
constexpr float kLongest = 3600.0f; // s
constexpr size_t kMostKeys = 1000;

/// The light of one moment, as a file says it.
struct Key
{
    double time = 0.0;
    std::string name;                             // for people
    std::shared_ptr<const JsonDocument> document; // that it stands in
    json light;
    std::string what; // "day.json: key 1"
    std::string path; // of the light in its document
    std::filesystem::path folder;

    /// The key with another light, for sentences about it.
    [[nodiscard]] JsonItem itemOf(const json& object) const
    {
        return {object, what, document->top().lines, path};
    }
};

/// What is between two keys.
class Blend
{
public:
    /// `share` is that of the second, 0..1.
    Blend(const Key& from, const Key& to, double share) : from_(from), to_(to), share_(share) {}

    [[nodiscard]] json light() const { return ofObjects(from_.light, to_.light, ""); }

private:
    [[nodiscard]] json of(const json& a, const json& b, const std::string& path) const;
    [[nodiscard]] json ofNumbers(double a, double b, const std::string& path) const;
    [[nodiscard]] json ofLists(const json& a, const json& b, const std::string& path) const;
    [[nodiscard]] const json& sameFixture(const json& fixture, const json& list, size_t place,
                                          const std::string& path) const;
    [[nodiscard]] json ofObjects(const json& a, const json& b, const std::string& path) const;
    [[noreturn]] void refuse(const std::string& path, const std::string& why) const;

    const Key& from_;
    const Key& to_;
    double share_;
};

void Blend::refuse(const std::string& path, const std::string& why) const
{
    from_.itemOf(from_.light)
        .refuse(fmt::format("\"{}\" {}; one key must lead to the next", path.substr(1), why),
                path.substr(1));
}

json Blend::ofNumbers(double a, double b, const std::string& path) const
{
    const bool inMired = path.ends_with("/kelvin") && a > 0.0 && b > 0.0;
    if (inMired) return 1.0 / ((1.0 - share_) / a + share_ / b);
    return (1.0 - share_) * a + share_ * b;
}

json Blend::ofLists(const json& a, const json& b, const std::string& path) const
{
    if (a.size() != b.size())
        refuse(path, fmt::format("has {} entries, and {} in {}", a.size(), b.size(), to_.what));
    json list = json::array();
    for (size_t i = 0; i < a.size(); ++i) {
        const std::string below = fmt::format("{}/{}", path, i);
        list.push_back(
            of(a[i], path == "/fixtures" ? sameFixture(a[i], b, i, below) : b[i], below));
    }
    return list;
}

/// The fixture of another list that has the number or the name of one; where it has neither, what
/// stands at its place there.
const json& Blend::sameFixture(const json& fixture, const json& list, size_t place,
                               const std::string& path) const
{
    for (const char* key : {"id", "name"}) {
        if (!fixture.is_object() || !fixture.contains(key)) continue;
        const auto same = std::find_if(list.begin(), list.end(), [&](const json& other) {
            return other.is_object() && other.contains(key) && other[key] == fixture[key];
        });
        if (same == list.end())
            refuse(path, fmt::format("is in one of this and {} alone", to_.what));
        return *same;
    }
    return list[place];
}

json Blend::ofObjects(const json& a, const json& b, const std::string& path) const
{
    std::set<std::string> keys;
    for (const json& object : {a, b})
        for (const auto& [key, value] : object.items()) keys.insert(key);
    json object = json::object();
    for (const std::string& key : keys) {
        const auto inA = a.find(key);
        const auto inB = b.find(key);
        const std::string below = fmt::format("{}/{}", path, key);
        if (inA != a.end() && inB != b.end())
            object[key] = of(*inA, *inB, below);
        else if (key == "dim") // 1 where it is not said
            object[key] = of(a.value(key, json(1.0)), b.value(key, json(1.0)), below);
        else if (key != "on") // true where it is not said
            refuse(below, fmt::format("is in one of this and {} alone", to_.what));
        else if (const auto& holder = share_ < 1.0 ? a : b; holder.contains(key))
            object[key] = holder[key];
    }
    return object;
}

json Blend::of(const json& a, const json& b, const std::string& path) const
{
    if (a == b) return a; // whole numbers stay whole
    if (a.is_number() && b.is_number()) return ofNumbers(a.get<double>(), b.get<double>(), path);
    if (a.is_array() && b.is_array()) return ofLists(a, b, path);
    if (a.is_object() && b.is_object()) return ofObjects(a, b, path);
    return share_ < 1.0 ? a : b; // a text or a switch stays until the next key
}

/// The light of a key: an object, or the name of a lights file.
void takeLight(const JsonItem& item, const std::filesystem::path& folder,
               const std::shared_ptr<const JsonDocument>& document, Key& key)
{
    const json* light = item.find("light");
    if (light == nullptr) item.refuse("\"light\" is missing");
    if (light->is_string()) {
        const std::filesystem::path file = folder / light->get<std::string>();
        key.document = std::make_shared<const JsonDocument>(file, kLightsFormat);
        key.light = key.document->top().object;
        key.what = file.string();
        key.folder = file.parent_path();
        return;
    }
    if (!light->is_object())
        item.refuse("\"light\" must be an object in { }, or the name of a lights file", "light");
    key.document = document;
    key.light = *light;
    key.what = item.what;
    key.path = item.path + "/light";
    key.folder = folder;
}

} // namespace

struct Timeline::State
{
    std::filesystem::path file;
    Lights captured;
    double seconds = 10.0;
    std::vector<Key> keys; // two or more, ascending in time
    NamedFiles files;      // of all keys, once they are checked

    [[nodiscard]] Relighting between(size_t key, double share)
    {
        std::vector<std::string> said; // when the keys were read
        const json light = Blend(keys[key], keys[key + 1], share).light();
        return relightingFrom(keys[key].itemOf(light), keys[key].folder, captured, files, said);
    }
    void read(const std::filesystem::path& file, std::vector<std::string>& warnings);
    void check(std::vector<std::string>& warnings);
};

void Timeline::State::read(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
    const auto document = std::make_shared<const JsonDocument>(file, kFormat);
    const JsonItem top = document->top();
    top.warnOfUnknown({"format", "seconds", "keys"}, warnings);
    seconds = top.size("seconds", 10.0f);
    if (!(seconds > 0.0 && seconds <= kLongest))
        top.refuse(fmt::format("\"seconds\" must be greater than 0 and no more than {}", kLongest),
                   "seconds");
    top.forEachIn("keys", "key", [&](const JsonItem& item) {
        item.warnOfUnknown({"time", "light", "name"}, warnings);
        Key key;
        key.time = item.numberAt("time");
        key.name = item.text("name", "");
        if (!keys.empty() && !(key.time > keys.back().time))
            item.refuse("\"time\" must be later than that of the key before", "time");
        if (keys.size() == kMostKeys) item.refuse("is one key too many");
        takeLight(item, file.parent_path(), document, key);
        keys.push_back(std::move(key));
    });
    if (keys.size() < 2) top.refuse("\"keys\" must be a list of two or more", "keys");
}

void Timeline::State::check(std::vector<std::string>& warnings)
{
    for (const Key& key : keys)
        relightingFrom(key.itemOf(key.light), key.folder, captured, files, warnings);
    for (size_t i = 0; i + 1 < keys.size(); ++i) (void)between(i, 0.5);
}

Timeline::Timeline(const std::filesystem::path& file, const Lights& captured,
                   std::vector<std::string>& warnings)
    : state_(std::make_unique<State>())
{
    state_->file = file;
    state_->captured = captured;
    state_->read(file, warnings);
    state_->check(warnings);
}

Timeline::~Timeline() = default;
Timeline::Timeline(Timeline&&) noexcept = default;
Timeline& Timeline::operator=(Timeline&&) noexcept = default;

double Timeline::seconds() const
{
    return state_->seconds;
}

const std::filesystem::path& Timeline::file() const
{
    return state_->file;
}

std::vector<TimelineKey> Timeline::keys() const
{
    std::vector<TimelineKey> list;
    const double first = state_->keys.front().time;
    const double whole = state_->keys.back().time - first;
    for (const Key& key : state_->keys)
        list.push_back({key.time, (key.time - first) / whole, key.name});
    return list;
}

Relighting Timeline::at(double part) const
{
    const std::vector<Key>& keys = state_->keys;
    const double first = keys.front().time;
    const double time = first + std::clamp(part, 0.0, 1.0) * (keys.back().time - first);
    const auto after = std::find_if(keys.begin() + 1, keys.end() - 1,
                                    [&](const Key& key) { return time < key.time; });
    const Key& from = *(after - 1);
    return state_->between(static_cast<size_t>(after - 1 - keys.begin()),
                           (time - from.time) / (after->time - from.time));
}

} // namespace relamp
