#pragma once

#include "camera_rig.h"
#include "edit.h"
#include "history.h"
#include "mailbox.h"
#include "open_room.h"
#include "read_room.h"
#include "room_drawing.h"
#include "room_light.h"
#include "solving.h"
#include "worker.h"

#include <chrono>
#include <deque>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

<<<<<<< HEAD
/// The solver and its parameters, as far as the viewer has them.
struct SolverParameters
{
    relamp::Solver solver = relamp::Solver::gather;
    relamp::GatherOptions gather;
    relamp::PathtraceOptions pathtrace;
    relamp::ThesisOptions thesis;
    relamp::AlbedoOptions albedo;

    bool operator==(const SolverParameters& other) const = default;
    [[nodiscard]] relamp::DelightOptions options() const;
};

/// What a person may change and take back.
struct Edit
{
    LightDocument light;  // how it shall shine now
    ScannedItems scanned; // how it was on the day of the scan
    relamp::ViewOptions view;
    SolverParameters parameters;

    bool operator==(const Edit& other) const;
};

struct Selection
{
    enum class Kind { none, lamp, fixture };
    Kind kind = Kind::none;
    size_t index = 0;

    bool operator==(const Selection&) const = default;
};

/// How far the room has been taken apart.
enum class Stage { nothing, reading, scanned, drafted, solved };

=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
/// The room that is open, its light, and all that works on it: the viewer without its window.
class Studio
{
public:
    Studio(RoomDrawing& drawing, const relamp::EngineOptions& engine,
           const std::function<void()>& wake);

    /// Reads a scan or a folder of relamp delight, and solves. What was open stays as it is until
    /// that is read, and if it cannot be.
    void open(const std::filesystem::path& path, const relamp::ScanOptions& options);
    /// Opens what it is: a scan, a folder, a lights file, a timeline.
    void openAny(const std::filesystem::path& path);
    /// Takes over what the threads have found; false where that is nothing. To be called once a
    /// frame.
    bool deliver() { return mailbox_.deliver(); }

    /// Makes `edit` count: to be called after it was changed, with a name for the step.
    void commit(const std::string& step);
    void settle() { history_.settle(); }
    void undo();
    void redo();
    [[nodiscard]] const History<Edit>& history() const { return history_; }
    void stopSolving();

    void saveLights(const std::filesystem::path& file);
    void loadLights(const std::filesystem::path& file);
    void saveResult(const std::filesystem::path& folder);
    void saveBaked(const std::filesystem::path& file);
    void loadTimeline(const std::filesystem::path& file);
    void play(bool on);
    [[nodiscard]] bool isPlaying() const { return room_.isPlaying; }
    /// Moves the timeline on, where one plays.
    void passTime(double seconds);
    void seek(double part);
    [[nodiscard]] double timelinePart() const { return room_.part; }
    [[nodiscard]] bool hasTimeline() const { return room_.timeline.has_value(); }

    [[nodiscard]] const relamp::Scan* scan() const { return room_.scan.get(); }
    [[nodiscard]] const relamp::Lights& captured() const { return room_.captured; }
    /// Before anybody said how it was on the day of the scan.
    [[nodiscard]] const relamp::Lights& found() const { return room_.found; }
    [[nodiscard]] const std::filesystem::path& path() const { return room_.path; }
    [[nodiscard]] Stage stage() const { return opening_ ? Stage::reading : room_.stage; }
    /// Whether albedo is behind what was said.
<<<<<<< HEAD
    [[nodiscard]] bool reevaluates() const { return reevaluating_.has_value(); }
    [[nodiscard]] const relamp::Bounds& bounds() const { return bounds_; }
    [[nodiscard]] const std::optional<relamp::Closure>& closure() const { return closure_; }
    [[nodiscard]] double glanceMilliseconds() const { return glanceMilliseconds_; }
    /// Of the last time that albedo followed, until it was there to be drawn.
    [[nodiscard]] std::optional<double> reevaluateMilliseconds() const
    {
        return reevaluateMilliseconds_;
    }
    /// Whether light that counts now is on the walls: glanced at, or found for every texel.
    [[nodiscard]] bool isGlanced() const;
    [[nodiscard]] bool isRelit() const;
=======
    [[nodiscard]] bool resolves() const { return resolving_.has_value(); }
    [[nodiscard]] relamp::Bounds bounds() const
    {
        return room_.mesh ? room_.mesh->bounds : relamp::Bounds{};
    }
    [[nodiscard]] const std::optional<relamp::Closure>& closure() const { return room_.closure; }
    [[nodiscard]] const RoomLight& light() const { return light_; }
    /// Of the last time that albedo followed, until it was there to be drawn.
    [[nodiscard]] std::optional<double> resolveMilliseconds() const
    {
        return room_.resolveMilliseconds;
    }
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
    [[nodiscard]] bool rests() const;
    [[nodiscard]] WorkStatus solving() const { return solver_.status(); }
    [[nodiscard]] bool isSaving() const { return saver_.status().isBusy || light_.status().bakes; }

    /// What to tell the person, the newest last; a sentence each.
    std::deque<std::string> messages;
    void say(const std::string& sentence);
    [[nodiscard]] bool hasFailed() const { return hasFailed_; } // since the last `open`
    [[nodiscard]] size_t failures() const { return failures_; } // so far
    [[nodiscard]] size_t openings() const { return openings_; } // that were begun so far

    Edit edit;
    Selection selection;
    CameraRig camera;
    bool isCameraUntouched = true;

private:
    /// A room that is being read.
    struct Opening
    {
        size_t number = 0;           // of all that were to be opened
        SolverParameters parameters; // that it will be solved with
        bool reevaluated = false;    // the one before it was being re-evaluated
    };
<<<<<<< HEAD
    /// What its thread needs to know.
    struct Wish
    {
        std::filesystem::path path;
        relamp::ScanOptions scan;
        relamp::DelightOptions parameters;
        size_t number;
    };
    /// It was read.
    struct Opened
    {
        Wish wish;
        std::shared_ptr<const relamp::Scan> scan;
        std::shared_ptr<const RoomMesh> mesh;
        std::vector<TexturePixels> textures;
        std::shared_ptr<RoomSolver> solver; // none of a folder
    };
=======
    using Adopt = void (Studio::*)(const Solved&);
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605

    // studio_room.cpp: it is read, and solved
    void adopt(const ReadRoom& read);
    void look(const Surroundings& around);
    void goOn(size_t failed);
<<<<<<< HEAD
    void adopt(const Solved& solved);
    void adoptTextures(const Solved& solved);
    void adoptReevaluated(const Solved& solved);
    void adoptFixtures(const Solved& solved);
    void apply(const Edit& before);
    void follow(const Edit& before);
    void sendLight();
=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
    void solveAgain();
    void reevaluate();
    [[nodiscard]] bool canReevaluate() const;
    [[nodiscard]] ScannedLight scannedLight() const;
    [[nodiscard]] relamp::DelightOptions optionsOf(const Dials& dials) const;
    [[nodiscard]] std::function<void(Solved)> sendTo(Adopt adopt,
                                                     const std::shared_ptr<RoomSolver>& from);
    void adoptSolved(const Solved& solved);
    void adoptResolved(const Solved& solved);
    void adoptTextures(const Solved& solved);
    void adoptFixtures(const Solved& solved);

    // studio.cpp: what a person changes is followed
    void apply(const Edit& before);
    void follow(const Edit& before);
    void sendLight();
    void tell(const std::vector<std::string>& notes);
    void fail(const std::string& sentence);
<<<<<<< HEAD
    void readScan(const Wish& wish, relamp::Progress& progress);
    void readFolder(const Wish& wish, relamp::Progress& progress);
    void find(const std::shared_ptr<const relamp::DelitRoom>& room, relamp::Progress& progress);
    [[nodiscard]] std::filesystem::path besideScan() const;
    [[nodiscard]] relamp::DelightOptions optionsOf(const SolverParameters& parameters) const;
=======
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605

    RoomDrawing& drawing_;
    relamp::EngineOptions engine_;
    Mailbox mailbox_;
    OpenRoom room_;
    std::optional<Opening> opening_;
    size_t openings_ = 0;
<<<<<<< HEAD
    Stage stage_ = Stage::nothing; // of what is open
    SolverParameters solvedBy_;    // it is, or is on the way to be
    bool hasFailed_ = false;
    size_t failures_ = 0;
    bool isGlanced_ = false;
    bool isRelit_ = false;
    bool isLightOfScan_ = true; // as the room's own
    double glanceMilliseconds_ = 0.0;
    std::optional<std::chrono::steady_clock::time_point> reevaluating_; // since when
    std::optional<double> reevaluateMilliseconds_;
    std::optional<relamp::Timeline> timeline_;
    bool isPlaying_ = false;
    double part_ = 0.0;
=======
    std::optional<std::chrono::steady_clock::time_point> resolving_; // since when
    bool hasFailed_ = false;
    size_t failures_ = 0;
>>>>>>> f9eea98772763ae505793aee9f146a4ce5d07605
    Edit applied_;
    History<Edit> history_;
    RoomLight light_; // these three use all of the above
    Worker solver_;
    Worker saver_;
};
