#include "output/video_file.h"

#include "base/fail.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <string>
#include <vector>

#include <fcntl.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern char** environ;

namespace relamp
{
namespace
{

/// Ends ffmpeg's life as a child; its exit status, or -1 where a signal ended it.
int waitFor(pid_t process)
{
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
    }
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> commandLine(Size size, double framesPerSecond,
                                     const std::filesystem::path& file)
{
    return {"ffmpeg", "-nostdin", "-hide_banner", "-loglevel", "error", "-y",
            // what comes in
            "-f", "rawvideo", "-pixel_format", "rgb24", "-video_size",
            fmt::format("{}x{}", size.width, size.height), "-framerate",
            fmt::format("{}", framesPerSecond), "-i", "pipe:0",
            // H.264 in the colours of HDTV, as every player shows it
            "-vf", "scale=out_color_matrix=bt709:out_range=tv,format=yuv420p", "-colorspace",
            "bt709", "-color_primaries", "bt709", "-color_trc", "iec61966-2-1", "-color_range",
            "tv", "-c:v", "libx264", "-crf", "16", "-preset", "medium", "-movflags", "+faststart",
            // the same bytes on every machine with this ffmpeg, whatever its number of cores
            "-threads", "2", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1",
            "-f", "mp4", file.string()};
}

} // namespace

VideoFile::VideoFile(const std::filesystem::path& file, Size size, double framesPerSecond,
                     Progress& progress)
    : file_(file), staged_(file, progress), complaints_(std::tmpfile())
{
    if (size.width % 2 != 0 || size.height % 2 != 0)
        fail(ErrorCode::cannotWrite, file.string(),
             fmt::format("a video's width and height must be even; {} x {} is not", size.width,
                         size.height));
    if (complaints_ == nullptr)
        fail(ErrorCode::cannotWrite, file.string(),
             fmt::format("no temporary file can be made: {}", std::strerror(errno)));
    start(size, framesPerSecond);
}

VideoFile::~VideoFile()
{
    closeInput();
    if (ffmpeg_ > 0) {
        kill(ffmpeg_, SIGKILL);
        waitFor(ffmpeg_);
    }
    if (complaints_ != nullptr) std::fclose(complaints_);
}

void VideoFile::start(Size size, double framesPerSecond)
{
    std::array<int, 2> ends{}; // a socket rather than a pipe: writing to it raises no SIGPIPE
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0)
        fail(ErrorCode::cannotWrite, file_.string(), std::strerror(errno));
    input_ = ends[0];

    std::vector<std::string> words = commandLine(size, framesPerSecond, staged_.path());
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);

    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_adddup2(&files, ends[1], STDIN_FILENO);
    posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    posix_spawn_file_actions_adddup2(&files, fileno(complaints_), STDERR_FILENO);
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP); // Ctrl-C is relamp's to handle
    const int failure =
        posix_spawnp(&ffmpeg_, "ffmpeg", &files, &attributes, arguments.data(), environ);
    posix_spawnattr_destroy(&attributes);
    posix_spawn_file_actions_destroy(&files);
    close(ends[1]);
    if (failure == 0) return;
    ffmpeg_ = -1;
    closeInput();
    std::fclose(complaints_);
    complaints_ = nullptr;
    fail(ErrorCode::cannotWrite, file_.string(),
         failure == ENOENT
             ? "needs the program ffmpeg, which is not installed; install it (apt install ffmpeg), "
               "or name a folder with -o for numbered pictures"
             : fmt::format("ffmpeg cannot be run: {}", std::strerror(failure)));
}

void VideoFile::closeInput()
{
    if (input_ >= 0) close(input_);
    input_ = -1;
}

void VideoFile::failWithReason()
{
    closeInput();
    if (ffmpeg_ > 0) {
        kill(ffmpeg_, SIGKILL);
        waitFor(ffmpeg_);
        ffmpeg_ = -1;
    }
    std::array<char, 400> text{};
    std::rewind(complaints_);
    const size_t length = std::fread(text.data(), 1, text.size(), complaints_);
    std::string said(text.data(), length);
    said.erase(std::min(said.find('\n'), said.size()));
    fail(ErrorCode::cannotWrite, file_.string(),
         "ffmpeg has given up: " + (said.empty() ? "it does not say why" : said));
}

void VideoFile::add(std::span<const uint8_t> rgb)
{
    while (!rgb.empty()) {
        const ssize_t sent = send(input_, rgb.data(), rgb.size(), MSG_NOSIGNAL);
        if (sent < 0 && errno == EINTR) continue;
        if (sent < 0) failWithReason();
        rgb = rgb.subspan(static_cast<size_t>(sent));
    }
}

void VideoFile::commit()
{
    closeInput();
    const int status = waitFor(ffmpeg_);
    ffmpeg_ = -1;
    if (status != 0) failWithReason();
    staged_.commit();
}

} // namespace relamp
