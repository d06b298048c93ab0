#include "ui/cli/compare_tracers_output.h"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <sstream>

namespace raylab {
namespace {

using Json = nlohmann::ordered_json;

constexpr size_t kPrintedOffenders = 4;

struct CountColumn {
    const char* json;
    const char* heading;
    uint64_t DifferenceCounts::*count;
};

/// In the order in which they are printed and written.
constexpr std::array kColumns = {
    CountColumn{"rays", "rays", &DifferenceCounts::rays},
    CountColumn{"hitMiss", "hit/miss", &DifferenceCounts::hitMiss},
    CountColumn{"instance", "instance", &DifferenceCounts::instance},
    CountColumn{"primitive", "primitive", &DifferenceCounts::primitive},
    CountColumn{"t", "t>1e-5", &DifferenceCounts::t},
    CountColumn{"tUlp1", "t>1ulp", &DifferenceCounts::tUlp1},
    CountColumn{"tUlp4", "t>4ulp", &DifferenceCounts::tUlp4},
    CountColumn{"barycentrics", "uv>1e-4", &DifferenceCounts::barycentrics},
    CountColumn{"aWrong", "A wrong", &DifferenceCounts::aWrong},
    CountColumn{"bWrong", "B wrong", &DifferenceCounts::bWrong},
    CountColumn{"bothWrong", "both wrong", &DifferenceCounts::bothWrong},
    CountColumn{"ties", "ties", &DifferenceCounts::ties},
    CountColumn{"undecidable", "undecidable", &DifferenceCounts::undecidable},
};

Json countsJson(const DifferenceCounts& counts) {
    Json json;
    for (const CountColumn& column : kColumns) json[column.json] = counts.*column.count;
    return json;
}

void printCounts(std::string_view name, const DifferenceCounts& counts) {
    std::cout << "  " << std::left << std::setw(11) << name << std::right;
    for (const CountColumn& column : kColumns)
        std::cout << std::setw(static_cast<int>(std::max<size_t>(std::string_view(column.heading).size(), 8)) + 2)
                  << counts.*column.count;
    std::cout << "\n";
}

std::string hitText(const shared::HitData& hit, bool anyHit) {
    if (anyHit) return hit.t >= 0.0f ? "occluded" : "free";
    if (hit.t < 0.0f) return "miss";
    std::ostringstream text;
    text << std::setprecision(9) << "t " << hit.t << " instance " << hit.instance << " primitive " << hit.primitive;
    return text.str();
}

std::string truthText(const TrueHit& truth) {
    if (!truth.hit()) return "miss";
    std::ostringstream text;
    text << std::setprecision(12) << "t " << truth.t << " instance " << truth.instance << " primitive "
         << truth.primitive;
    return text.str();
}

void printOffenders(const RayComparison& hits) {
    for (size_t i = 0; i < std::min(kPrintedOffenders, hits.offenders.size()); ++i) {
        const Offender& o = hits.offenders[i];
        std::cout << std::setprecision(9) << "  " << o.kind << ", " << kRayStates[static_cast<size_t>(o.state)].meaning
                  << "\n    from " << o.ray.origin.x << " " << o.ray.origin.y << " " << o.ray.origin.z << " towards "
                  << o.ray.direction.x << " " << o.ray.direction.y << " " << o.ray.direction.z << "\n    A "
                  << hitText(o.a, o.anyHit) << "\n    B " << hitText(o.b, o.anyHit) << "\n    in double precision "
                  << truthText(o.truth) << "\n";
    }
    if (hits.offenders.size() > kPrintedOffenders)
        std::cout << "  --json lists " << hits.offenders.size() << " such rays\n";
}

void printHits(const RayComparison& hits) {
    std::cout << "first hits: how many rays A and B answer differently, and who is right in double precision\n  "
              << std::setw(11) << "";
    for (const CountColumn& column : kColumns) std::cout << "  " << std::setw(8) << column.heading;
    std::cout << "\n";
    for (const KindCounts& kind : hits.kinds)
        if (kind.counts.rays > 0) printCounts(kind.kind.name, kind.counts);
    printCounts("all", hits.total());
    std::cout
        << "  the oracle judges what differs in hit or miss, instance, primitive or t beyond 1e-5; a tie is a shared "
           "edge or\n  coplanar surfaces, undecidable a ray that passes an edge closer than floats can tell\n";
    printOffenders(hits);
}

void printImages(const ImageComparison& images) {
    std::cout << std::defaultfloat << std::setprecision(6) << "images: " << images.samples[0] << " samples of A, "
              << images.samples[1] << " of B, RMSE " << images.error.rmse << ", largest difference "
              << images.error.maxAbs;
    if (images.zTest)
        std::cout << ", Z-test " << 100.0 * images.zTest->passFraction << " % of " << images.zTest->pixels
                  << " pixels pass";
    std::cout << "\n";
}

void printTimes(const std::vector<KindTimes>& times) {
    std::cout << "times: medians in Mrays/s, [intervals]\n";
    for (const KindTimes& row : times)
        std::cout << std::fixed << std::setprecision(3) << "  " << std::left << std::setw(11) << row.a.rayKind
                  << std::right << std::setw(8) << row.a.rays << " rays  A " << row.a.mraysPerSecond << " ["
                  << row.a.low << ", " << row.a.high << "]  B " << row.b.mraysPerSecond << " [" << row.b.low << ", "
                  << row.b.high << "]  B/A " << row.ratio() << " [" << row.lowRatio() << ", " << row.highRatio()
                  << "]\n"
                  << std::defaultfloat;
}

Json vectorJson(const glm::vec3& v) { return {v.x, v.y, v.z}; }

Json hitJson(const shared::HitData& hit, bool anyHit) {
    Json json{{"hit", hit.t >= 0.0f}};
    if (anyHit || hit.t < 0.0f) return json;
    json.update({{"t", hit.t}, {"u", hit.u}, {"v", hit.v}, {"instance", hit.instance}, {"primitive", hit.primitive}});
    return json;
}

Json truthJson(const TrueHit& truth) {
    Json json{{"hit", truth.hit()}};
    if (truth.hit()) json.update({{"t", truth.t}, {"instance", truth.instance}, {"primitive", truth.primitive}});
    return json;
}

Json offendersJson(const RayComparison& hits) {
    constexpr std::array kNames = {"equal",  "tOnly",  "tie",       "undecidable",
                                   "aWrong", "bWrong", "bothWrong", "notCompared"};
    static_assert(kNames.size() == kRayStates.size());
    Json list = Json::array();
    for (const Offender& o : hits.offenders)
        list.push_back({{"rayKind", o.kind},
                        {"verdict", kNames[static_cast<size_t>(o.state)]},
                        {"origin", vectorJson(o.ray.origin)},
                        {"direction", vectorJson(o.ray.direction)},
                        {"tMin", o.ray.tMin},
                        {"tMax", o.ray.tMax},
                        {"key", o.key},
                        {"a", hitJson(o.a, o.anyHit)},
                        {"b", hitJson(o.b, o.anyHit)},
                        {"truth", truthJson(o.truth)}});
    return list;
}

Json finiteOrNull(double value) { return std::isfinite(value) ? Json(value) : Json(); }

Json imagesJson(const ImageComparison& images) {
    return {{"samplesA", images.samples[0]},
            {"samplesB", images.samples[1]},
            {"rmse", finiteOrNull(images.error.rmse)},
            {"relMse", finiteOrNull(images.error.relMse)},
            {"maxAbs", finiteOrNull(images.error.maxAbs)},
            {"nonFinite", images.error.nonFinite},
            {"zTestPassFraction", images.zTest ? Json(images.zTest->passFraction) : Json()},
            {"passed", images.passed}};
}

Json rateJson(const BenchRow& row) {
    return {{"mraysPerSecond", row.mraysPerSecond}, {"low", row.low}, {"high", row.high}, {"hits", row.hits}};
}

Json timesJson(const std::vector<KindTimes>& times) {
    Json list = Json::array();
    for (const KindTimes& row : times)
        list.push_back({{"rayKind", row.a.rayKind},
                        {"rays", row.a.rays},
                        {"a", rateJson(row.a)},
                        {"b", rateJson(row.b)},
                        {"ratio", row.ratio()},
                        {"ratioLow", row.lowRatio()},
                        {"ratioHigh", row.highRatio()}});
    return list;
}

}  // namespace

void printCompareTracers(const CompareTracersRun& run) {
    for (size_t i = 0; i < 2; ++i)
        std::cout << (i == 0 ? "A  " : "B  ") << run.sides[i].text
                  << (run.sides[i].isDefault ? "  (the default software configuration)" : "") << "\n";
    if (run.hits) printHits(*run.hits);
    if (run.images) printImages(*run.images);
    if (run.times) printTimes(*run.times);
    for (const std::string& sentence : run.leftOut) std::cout << "partial: " << sentence << "\n";
    for (const std::string& sentence : run.failures) std::cout << "FAILED: " << sentence << "\n";
}

void printHeatLegend() {
    std::cout << "the map's colours\n";
    for (const RayStateInfo& info : kRayStates)
        std::cout << "  " << std::left << std::setw(9) << info.color << std::right << info.meaning << "\n";
}

nlohmann::ordered_json compareTracersJson(const CompareTracersRun& run) {
    Json json{{"schema", "raylab.compare-tracers/1"},
              {"version", RAYLAB_VERSION},
              {"scene", run.scene},
              {"device", run.device.description().name},
              {"driver", run.device.description().driver},
              {"sides", {{"a", run.sides[0].text}, {"b", run.sides[1].text}}},
              {"settings", {{"a", settingsJson(run.sides[0].settings)}, {"b", settingsJson(run.sides[1].settings)}}},
              {"isDefault", {{"a", run.sides[0].isDefault}, {"b", run.sides[1].isDefault}}}};
    if (run.hits) {
        json.update(countsJson(run.hits->total()));
        Json kinds = Json::array();
        for (const KindCounts& kind : run.hits->kinds) {
            Json row{{"rayKind", kind.kind.name}};
            row.update(countsJson(kind.counts));
            kinds.push_back(row);
        }
        json["kinds"] = kinds;
        json["offenders"] = offendersJson(*run.hits);
    }
    if (run.images) json["images"] = imagesJson(*run.images);
    if (run.times) json["times"] = timesJson(*run.times);
    json["complete"] = run.leftOut.empty();
    json["leftOut"] = run.leftOut;
    json["passed"] = run.failures.empty();
    json["failures"] = run.failures;
    return json;
}

}  // namespace raylab
