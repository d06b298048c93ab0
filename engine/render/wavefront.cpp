#include "engine/render/wavefront.h"

#include <algorithm>

#include "engine/core/error.h"
#include "engine/gpu/subgroups.h"
#include "engine/render/kernel_file.h"
#include "engine/render/render_constants.h"
#include "shaders/shared/bindings.h"

namespace raylab {
namespace {

constexpr size_t kWordBytes = 16;
constexpr BindingInfo kPaths{shared::kBindPaths, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
constexpr BindingInfo kQueues{shared::kBindQueues, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER};
/// Of a scene that is flat along an axis.
constexpr float kSmallestExtent = 1e-30f;
constexpr uint32_t kArraysUnsorted = 2;
constexpr uint32_t kArraysSorted = 4;

bool sortsRays(uint32_t order) { return order == shared::kOrderOctant || order == shared::kOrderOrigin; }

/// Of a number of groups that holds so many lanes.
uint32_t groupsOf(uint32_t lanes) { return (lanes + shared::kWorkgroupSize - 1) / shared::kWorkgroupSize; }

/// The heads of empty queues: indirect dispatches of no groups, and no key has been counted.
std::vector<uint32_t> emptyHeads() {
    std::vector<uint32_t> words(shared::kFirstPlace, 0);
    for (uint32_t queue = 0; queue < shared::kQueueCount; ++queue) {
        words[queue * shared::kArgumentWords + 1] = 1;
        words[queue * shared::kArgumentWords + 2] = 1;
    }
    return words;
}

/// What a step writes, the next one may read.
void orderSteps(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{VK_STRUCTURE_TYPE_MEMORY_BARRIER};
    barrier.srcAccessMask = VK_ACCESS_MEMORY_WRITE_BIT;
    barrier.dstAccessMask = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1,
                         &barrier, 0, nullptr, 0, nullptr);
}

}  // namespace

std::optional<WavefrontPlan> planWavefront(const Device& device, const PreparedScene& prepared,
                                           const RenderSettings& settings) {
    if (settings.schedule != "wavefront") return std::nullopt;
    if (settings.integrator != "path")
        throw Error("--schedule wavefront is for --integrator path; --integrator " + settings.integrator +
                    " wants --schedule mega");
    requireSubgroups(device, VK_SUBGROUP_FEATURE_BALLOT_BIT, "--schedule wavefront", "ballots",
                     "use --schedule mega, or another device (raylab devices)");
    constexpr uint32_t lights = shared::kNeedEmissive | shared::kNeedPunctual | shared::kNeedEnvironment;
    WavefrontPlan plan;
    plan.words = shared::pathWordCount(prepared.kernelNeeds, prepared.gpu->hasLightTree() ? 1 : 0);
    const uint64_t fitting = device.limits().maxStorageBufferRange / (kWordBytes * plan.words);
    plan.capacity = static_cast<uint32_t>(std::min<uint64_t>(static_cast<uint64_t>(settings.queuePaths), fitting)) /
                    shared::kWorkgroupSize * shared::kWorkgroupSize;
    plan.order = choiceIndex(settings, "queue-order");
    plan.sampled = (prepared.kernelNeeds & lights) != 0;
    plan.outlasting = settings.depth >= shared::kMostRounds || (prepared.kernelNeeds & shared::kNeedNesting) != 0;
    return plan;
}

size_t pathBytes(uint32_t needs, bool hasLightTree) {
    return kWordBytes * shared::pathWordCount(needs, hasLightTree ? 1 : 0) + sizeof(uint32_t) * kArraysUnsorted;
}

Wavefront::Wavefront(Device& device, const WavefrontPlan& plan, const KernelLayout& layout) : plan_(plan) {
    const size_t arrays = plan.order == shared::kOrderArrival ? kArraysUnsorted : kArraysSorted;
    const std::vector<uint32_t> heads = emptyHeads();
    paths_ = Buffer(device, "paths", kWordBytes * plan.words * plan.capacity, VK_BUFFER_USAGE_STORAGE_BUFFER_BIT,
                    BufferPlace::device);
    queues_ = Buffer(
        device, "queues", sizeof(uint32_t) * (shared::kFirstPlace + arrays * plan.capacity),
        VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        BufferPlace::device);
    empty_ = makeDeviceBuffer(device, "heads of empty queues", std::as_bytes(std::span(heads)),
                              VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    bindBuffer(device, layout, kPaths, paths_.get(), 0, paths_.sizeBytes());
    bindBuffer(device, layout, kQueues, queues_.get(), 0, queues_.sizeBytes());
}

std::array<BindingInfo, 2> Wavefront::bindings() { return {kPaths, kQueues}; }

void Wavefront::makeKernels(Device& device, const PreparedScene& prepared, const KernelLayout& layout,
                            std::vector<SpecConstant> constants) {
    constants.push_back({shared::kSpecQueueOrder, plan_.order});
    const auto atStage = [&](uint32_t stage) {
        std::vector<SpecConstant> all = constants;
        all.push_back({shared::kSpecStage, stage});
        return all;
    };
    const auto trace = [&](uint32_t stage) {
        return makeSceneKernel(device, prepared, layout, KernelKind::wavefront, atStage(stage));
    };
    const auto step = [&](const char* name, uint32_t stage = 0) {
        std::vector<SpecConstant> all = atStage(stage);
        const std::vector<SpecConstant> ofScene = sceneConstants(prepared);
        all.insert(all.end(), ofScene.begin(), ofScene.end());
        return makeComputeKernel(device, layout, kernelFile(KernelKind::wavefront, name), all);
    };
    generate_ = step("generate.comp");
    closest_ = trace(shared::kStageClosest);
    shade_ = step("shade.comp");
    if (plan_.sampled) shadow_ = trace(shared::kStageShadow);
    if (plan_.outlasting) finish_ = trace(shared::kStageFinish);
    if (plan_.order != shared::kOrderArrival) {
        scan_ = step("sort.comp", shared::kStageScan);
        scatter_ = step("sort.comp", shared::kStageScatter);
    }
    film_ = step("film.comp");
}

/// Records the steps of one slice, each behind the one before.
class Wavefront::Recorder {
public:
    Recorder(const Wavefront& owner, const Device& device, VkCommandBuffer commands, const KernelLayout& layout,
             const WavefrontSlice& slice)
        : owner_(owner), device_(device), commands_(commands), layout_(layout), slice_(slice) {
        push_.slice = slice.pixels;
        push_.capacity = owner.plan_.capacity;
        push_.lanes = slice.tileCount > 1 ? slice.tileCount * shared::kWorkgroupSize : slice.pixels.laneCount;
        push_.pathsPerLane = slice.pathsPerLane;
        push_.cellOrigin = slice.bounds.lo;
        push_.cellScale = static_cast<float>(shared::kCellsPerAxis) /
                          glm::max(slice.bounds.hi - slice.bounds.lo, glm::vec3(kSmallestExtent));
    }

    void empty() {
        const VkBufferCopy heads{0, 0, owner_.empty_.sizeBytes()};
        vkCmdCopyBuffer(commands_, owner_.empty_.get(), owner_.queues_.get(), 1, &heads);
    }

    void beginRound(uint32_t round) { push_.round = round; }

    void overTiles(const Kernel& kernel) { overGroups(kernel, slice_.tileCount); }

    void overGroups(const Kernel& kernel, uint32_t groups) {
        orderSteps(commands_);
        launch(device_, commands_, layout_, kernel, std::span(&slice_.filmOffset, 1), &push_, groups);
    }

    /// A ray tracing pipeline is launched over as many lanes as there may be paths: not every device counts its rays
    /// from a buffer.
    void overQueue(const Kernel& kernel, uint32_t queue) {
        if (kernel.bindPoint != VK_PIPELINE_BIND_POINT_COMPUTE) {
            overGroups(kernel, groupsOf(push_.lanes * push_.pathsPerLane));
            return;
        }
        orderSteps(commands_);
        launchIndirect(commands_, layout_, kernel, std::span(&slice_.filmOffset, 1), &push_, owner_.queues_.get(),
                       queue * shared::kArgumentWords * sizeof(uint32_t));
    }

    void sort(uint32_t queue) {
        overGroups(owner_.scan_, 1);
        overQueue(owner_.scatter_, queue);
    }

private:
    const Wavefront& owner_;
    const Device& device_;
    VkCommandBuffer commands_;
    const KernelLayout& layout_;
    const WavefrontSlice& slice_;
    shared::WavefrontPush push_{};
};

void Wavefront::record(const Device& device, VkCommandBuffer commands, const KernelLayout& layout,
                       const WavefrontSlice& slice) const {
    const uint32_t rounds = std::min(slice.maxDepth, shared::kMostRounds - 1) + 1;
    Recorder recorder(*this, device, commands, layout, slice);
    recorder.empty();
    recorder.overTiles(generate_);
    for (uint32_t round = 0; round < rounds; ++round) {
        recorder.beginRound(round);
        if (sortsRays(plan_.order) && round > 0) recorder.sort(round);
        recorder.overQueue(closest_, round);
        if (plan_.order == shared::kOrderMaterial) recorder.sort(round);
        recorder.overQueue(shade_, round);
        if (plan_.sampled) recorder.overQueue(shadow_, shared::kFirstShadowQueue + round);
    }
    if (plan_.outlasting) {
        recorder.beginRound(rounds);
        recorder.overQueue(finish_, rounds);
    }
    recorder.overTiles(film_);
}

}  // namespace raylab
