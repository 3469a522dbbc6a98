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
    /// The room for browsers: its own lights, as they are set or else as they were found, and those
    /// that were put up.
    void savePage(const std::filesystem::path& folder);
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
    [[nodiscard]] bool reevaluates() const { return reevaluating_.has_value(); }
    [[nodiscard]] relamp::Bounds bounds() const
    {
        return room_.mesh ? room_.mesh->bounds : relamp::Bounds{};
    }
    [[nodiscard]] const std::optional<relamp::Closure>& closure() const { return room_.closure; }
    /// Of what was solved here; none of a folder.
    [[nodiscard]] std::optional<relamp::CrossValidation> crossValidation() const
    {
        if (!room_.decomposition) return std::nullopt;
        return room_.decomposition->crossValidation();
    }
    [[nodiscard]] const RoomLight& light() const { return light_; }
    /// Of the last time that albedo followed, until it was there to be drawn.
    [[nodiscard]] std::optional<double> reevaluateMilliseconds() const
    {
        return room_.reevaluateMilliseconds;
    }
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
    std::optional<glm::vec3> place; // on the surface, that was clicked on
    std::optional<glm::vec3> paint; // a place that another is to be of one paint with
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
    using Adopt = void (Studio::*)(const Solved&);

    // studio_room.cpp: it is read, and solved
    void adopt(const ReadRoom& read);
    void look(const Surroundings& around);
    void goOn(size_t failed);
    void solveAgain();
    void reevaluate();
    [[nodiscard]] bool canReevaluate() const;
    [[nodiscard]] ScannedLight scannedLight() const;
    [[nodiscard]] relamp::Relighting lightOfPage(std::vector<std::string>& notes);
    [[nodiscard]] relamp::DelightOptions optionsOf(const SolverParameters& parameters) const;
    [[nodiscard]] std::function<void(Solved)> sendTo(Adopt adopt,
                                                     const std::shared_ptr<RoomSolver>& from);
    void adoptSolved(const Solved& solved);
    void adoptReevaluated(const Solved& solved);
    void adoptTextures(const Solved& solved);
    void adoptFixtures(const Solved& solved);

    // studio.cpp: what a person changes is followed
    void apply(const Edit& before);
    void follow(const Edit& before);
    void sendLight();
    void tell(const std::vector<std::string>& notes);
    void fail(const std::string& sentence);

    RoomDrawing& drawing_;
    relamp::EngineOptions engine_;
    Mailbox mailbox_;
    OpenRoom room_;
    std::optional<Opening> opening_;
    size_t openings_ = 0;
    std::optional<std::chrono::steady_clock::time_point> reevaluating_; // since when
    bool hasFailed_ = false;
    size_t failures_ = 0;
    Edit applied_;
    History<Edit> history_;
    RoomLight light_; // these three use all of the above
    Worker solver_;
    Worker saver_;
};
