#include "relamp/result.h"

#include "base/call_all.h"
#include "base/fail.h"
#include "base/file.h"
#include "base/half.h"
#include "base/parallel.h"
#include "decomposition_state.h"
#include "image/transfer.h"
#include "image/write_image.h"
#include "output/camera_plot.h"
#include "output/fixtures_file.h"
#include "output/lights_in_the_open.h"
#include "output/preview.h"
#include "output/report.h"
#include "output/result_folder.h"
#include "output/staged_folder.h"
#include "output/usd_lights.h"
#include "output/usd_scene.h"
#include "output/viewpoints.h"
#include "relamp/version.h"
#include "scan/gltf_write.h"

#include <algorithm>

namespace relamp
{
namespace
{

constexpr int kViewpoints = 3;
constexpr int kViewpointsOfDraft = 1;

std::vector<uint8_t> srgbBytes(const std::vector<uint16_t>& half)
{
    static const SrgbFromHalf srgb;
    std::vector<uint8_t> bytes(half.size());
    forEachChunk(half.size(), size_t{1} << 18, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) bytes[i] = srgb(half[i]);
    });
    return bytes;
}

std::vector<uint16_t> sumOf(const std::vector<uint16_t>& a, const std::vector<uint16_t>& b)
{
    std::vector<uint16_t> sum(a.size());
    forEachChunk(sum.size(), size_t{1} << 18, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i)
            sum[i] = halfFromFloat(floatFromHalf(a[i]) + floatFromHalf(b[i]));
    });
    return sum;
}

std::vector<float> floatsFrom(const std::vector<uint16_t>& half)
{
    std::vector<float> floats(half.size());
    for (size_t i = 0; i < half.size(); ++i) floats[i] = std::min(floatFromHalf(half[i]), 1.0f);
    return floats;
}

/// Colours of Doubt, as docs/guide/results.md lists them.
constexpr uint8_t kColorOfDoubt[kDoubts][3] = {
    {0, 0, 0},     {255, 64, 64}, {255, 255, 255}, {64, 64, 255}, {0, 192, 192},
    {192, 0, 192}, {255, 176, 0}, {0, 224, 0},     {160, 96, 32}, {128, 128, 128}};

std::vector<uint8_t> pictureOf(const std::vector<Doubt>& doubt)
{
    std::vector<uint8_t> rgb(3 * doubt.size());
    for (size_t i = 0; i < doubt.size(); ++i)
        std::copy_n(kColorOfDoubt[static_cast<size_t>(doubt[i])], 3, &rgb[3 * i]);
    return rgb;
}

class ResultWriter
{
public:
    ResultWriter(const Decomposition& result, StagedFolder& folder, const ResultOptions& options,
                 Progress& progress)
        : scan_(*result.scan()), result_(result), folder_(folder), options_(options),
          progress_(progress), relit_(scan_.pages.size()), usd_(scan_.pages.size())
    {}

    void run();
    /// m^2 of surface by Doubt, of the pages that are written.
    [[nodiscard]] const std::array<double, kDoubts>& area() const { return area_; }

private:
    void writePage(size_t page, const PageLayers& layers, Progress::Stage& stage);
    void writeAlbedo(size_t page, const PageLayers& layers);
    void writeDoubts(size_t page, const PageLayers& layers);
    void writeFixtures(size_t page, const PageLayers& layers);
    void writeCorrection(size_t page);
    [[nodiscard]] PreviewPicture drawPreview() const;
    void writePreview(const PreviewPicture& picture);
    void writeUsdPage(size_t page, const PageLayers& layers, const FixtureMap& map);
    void writeScan();
    [[nodiscard]] std::filesystem::path file(const char* layer, size_t page,
                                             const char* ending) const
    {
        return folder_ / nameOfLayer(layer, page, scan_.pages.size(), ending);
    }

    const Scan& scan_;
    const Decomposition& result_;
    StagedFolder& folder_;
    const ResultOptions& options_;
    Progress& progress_;
    std::vector<RelitPage> relit_;
    std::vector<UsdPage> usd_; // filled where it is asked for
    std::vector<PreviewPage> previews_;
    std::array<double, kDoubts> area_{};
};

void ResultWriter::writeAlbedo(size_t page, const PageLayers& layers)
{
    const Size size{layers.width, layers.height};
    const std::vector<uint8_t> rgb = srgbBytes(layers.albedo);
    const std::vector<uint8_t>& alpha = scan_.pages[page].image.alpha;
    EncodedImage png{alpha.empty() ? encodePng(rgb, size, 3)
                                   : encodePng(withAlpha(rgb, alpha), size, 4),
                     "image/png"};
    writeFile(file("albedo", page, "png"), std::as_bytes(std::span(png.bytes)));
    RelitPage& relit = relit_[page];
    if (scan_.pages[page].ofVertices) {
        relit.vertexAlbedo = floatsFrom(layers.albedo);
        return;
    }
    // A scan that came as JPEG stays as small as one.
    const bool asJpeg = scan_.pages[page].image.wasJpeg && alpha.empty();
    relit.albedo = asJpeg ? EncodedImage{encodeJpeg(rgb, size), "image/jpeg"} : std::move(png);
    if (!layers.emission.empty())
        relit.emission = asJpeg ? EncodedImage{encodeJpeg(layers.emission, size), "image/jpeg"}
                                : EncodedImage{encodePng(layers.emission, size, 3), "image/png"};
}

void ResultWriter::writePage(size_t page, const PageLayers& layers, Progress::Stage& stage)
{
    const Size size{layers.width, layers.height};
    const std::vector<uint16_t> shading = sumOf(layers.direct, layers.indirect);
    const auto write = [&](const char* layer, const std::vector<uint16_t>& rgb) {
        writeExr(file(layer, page, "exr"), rgb, size);
        stage.advance();
    };
    callAll([&] { writeAlbedo(page, layers); }, [&] { writeDoubts(page, layers); },
            [&] { writeFixtures(page, layers); }, [&] { writeCorrection(page); },
            [&] { write("albedo", layers.albedo); }, [&] { write("shading", shading); },
            [&] { write("direct", layers.direct); }, [&] { write("indirect", layers.indirect); });
    stage.advance();
}

void ResultWriter::writeDoubts(size_t page, const PageLayers& layers)
{
    const Size size{layers.width, layers.height};
    const auto png = encodePng(layers.confidence, size, 1);
    writeFile(file("confidence", page, "png"), std::as_bytes(std::span(png)));
    const auto why = encodePng(pictureOf(layers.doubt), size, 3);
    writeFile(file("reasons", page, "png"), std::as_bytes(std::span(why)));
}

void ResultWriter::writeFixtures(size_t page, const PageLayers& layers)
{
    const FixtureMap map = result_.fixtures(page);
    const auto png = encodePng(rgbOf(map), {map.width, map.height}, 3);
    writeFile(file("fixtures", page, "png"), std::as_bytes(std::span(png)));
    if (options_.usd) writeUsdPage(page, layers, map);
}

void ResultWriter::writeCorrection(size_t page)
{
    const CorrectionMap map = result_.correction(page);
    if (map.isEmpty()) return;
    const auto png = encodePng(map.share, {map.width, map.height}, 1);
    writeFile(file("correction", page, "png"), std::as_bytes(std::span(png)));
}

void ResultWriter::writeUsdPage(size_t page, const PageLayers& layers, const FixtureMap& map)
{
    const size_t pages = scan_.pages.size();
    const std::vector<uint16_t> emission = emissionBy(map, result_.lights());
    UsdPage& usd = usd_[page];
    if (scan_.pages[page].ofVertices) {
        usd.vertexAlbedo = floatsFrom(layers.albedo);
        for (const uint16_t half : emission) usd.vertexEmission.push_back(floatFromHalf(half));
        return;
    }
    usd.albedo = nameOfLayer("albedo", page, pages, "png");
    usd.hasOpacity = !scan_.pages[page].image.alpha.empty();
    if (emission.empty()) return;
    usd.emission = nameOfLayer("emission", page, pages, "exr");
    writeExr(folder_ / usd.emission, emission, {layers.width, layers.height});
}

PreviewPicture ResultWriter::drawPreview() const
{
    const Decomposition::State& state = result_.state();
    const bool isDraft = result_.optionsInForce().gather.quality == Quality::draft;
    const std::vector<Camera> cameras =
        chooseViewpoints(scan_, *state.scene, isDraft ? kViewpointsOfDraft : kViewpoints);
    PreviewPicture preview =
        renderPreview(*state.texels, *state.scene, previews_, cameras, progress_);
    drawCamera(result_.lights().camera, preview);
    return preview;
}

void ResultWriter::writePreview(const PreviewPicture& picture)
{
    const auto png = encodePng(picture.rgb, picture.size, 3);
    writeFile(folder_ / "preview.png", std::as_bytes(std::span(png)));
}

void ResultWriter::writeScan()
{
    Lights lights;                               // that a GLB can hold
    lights.fixtures = result_.lights().fixtures; // that name the points
    lights.points = inTheOpen(result_.mergedLights(), *result_.state().scene);
    lights.ambient = result_.lights().ambient;
    lights.sun = result_.lights().sun;
    writeFile(folder_ / (scan_.name + ".glb"), writeGlb(scan_, relit_, lights));
    writeFile(folder_ / "lights.json", lightsAsJson(result_.lights()));
    if (options_.usd)
        writeUsdScene(folder_ / (scan_.name + ".usda"), scan_, usd_, usdLightsOf(result_));
}

/// The preview is drawn before the last page is written: to compress it keeps one core busy for as
/// long as the page's files keep the others.
void ResultWriter::run()
{
    for (size_t page = 0; page < scan_.pages.size(); ++page) {
        const PageLayers layers = result_.layers(page, progress_);
        const bool isLast = page + 1 == scan_.pages.size();
        Progress::Stage stage(progress_, "write", 5);
        previews_.push_back(previewOf(scan_.pages[page], layers, scan_.pages.size()));
        for (size_t d = 0; d < kDoubts; ++d) area_[d] += layers.area[d];
        const PreviewPicture preview = isLast ? drawPreview() : PreviewPicture{};
        callAll(
            [&] {
                if (isLast) writePreview(preview);
            },
            [&] {
                writePage(page, layers, stage);
                if (isLast) writeScan();
            });
    }
}

} // namespace

std::string writeResult(const Decomposition& decomposition, const std::filesystem::path& scanFile,
                        const std::filesystem::path& folder, Progress& progress,
                        Replacing replacing, const ResultOptions& options)
{
    checkOutput(scanFile, folder, replacing, options);
    StagedFolder staged(folder, progress);
    ResultWriter writer(decomposition, staged, options, progress);
    writer.run();
    std::string report = reportAsJson(
        decomposition, {scanFile, folder, FolderRecord(staged.path(), kReport), writer.area()},
        progress);
    writeFile(staged / kReport, report);
    progress.check();
    checkOutput(scanFile, folder, replacing, options); // somebody may have edited it meanwhile
    staged.commit(kReport, FolderRecord::read(folder, kReport).names());
    return report;
}

void checkOutput(const std::filesystem::path& scanFile, const std::filesystem::path& folder,
                 Replacing replacing, const ResultOptions& options)
{
    const std::filesystem::path glb = folder / (scanFile.stem().string() + ".glb");
    std::error_code ignored;
    if (std::filesystem::equivalent(scanFile, glb, ignored))
        fail(ErrorCode::cannotWrite, glb.string(),
             "is the scan itself and would be overwritten; name another folder with -o");
    Progress nobody;
    const StagedFolder trial(folder, nobody);
    if (replacing == Replacing::any) return;
    const std::string scan = scanFile.stem();
    checkReplaceable(folder, FolderRecord::read(folder, kReport),
                     [&](const std::string& name) { return isOfResult(name, scan, options); });
}

const char* version()
{
    return RELAMP_VERSION;
}

} // namespace relamp
