#include "engine/gpu/specialise.h"

#include <cstring>
#include <spirv-tools/optimizer.hpp>
#include <string>
#include <unordered_map>

#include "engine/core/disk_cache.h"
#include "engine/core/error.h"
#include "engine/core/file.h"

namespace raylab {
namespace {

/// The version counts the list of passes too.
constexpr CacheFormat kFormat{{'r', 'a', 'y', 'l', 'a', 'b', 's', 'v'}, 1, ".spv", "kernels"};
constexpr uint64_t kCacheBytes = uint64_t{64} << 20;

[[noreturn]] void refuse(const std::filesystem::path& spirv, const std::string& why) {
    throw Error(spirv.string() + ": " + why + "; reinstall raylab", ExitCode::internalError);
}

Hash128 keyOf(std::span<const std::byte> code, std::span<const SpecConstant> constants) {
    const std::string_view tools = spvSoftwareVersionString();
    Hash128 key = hashBytes(code);
    key = hashItems(std::span<const char>(tools), key);
    return hashItems(constants, key);
}

std::vector<uint32_t> wordsOf(std::span<const std::byte> bytes) {
    std::vector<uint32_t> words(bytes.size() / sizeof(uint32_t));
    std::memcpy(words.data(), bytes.data(), words.size() * sizeof(uint32_t));
    return words;
}

std::unordered_map<uint32_t, std::vector<uint32_t>> valuesOf(std::span<const SpecConstant> constants) {
    std::unordered_map<uint32_t, std::vector<uint32_t>> values;
    for (const SpecConstant& constant : constants) values[constant.id] = {constant.value};
    return values;
}

/// Functions that only dead branches call go before the others are inlined, so that what is left is small soon.
void addPasses(spvtools::Optimizer& optimizer, std::span<const SpecConstant> constants) {
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(valuesOf(constants)))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass())
        .RegisterPass(spvtools::CreateCFGCleanupPass())
        .RegisterPass(spvtools::CreateStripDebugInfoPass());
}

std::vector<uint32_t> specialise(const std::filesystem::path& spirv, const std::vector<uint32_t>& code,
                                 std::span<const SpecConstant> constants) {
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    std::string messages;
    optimizer.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
        messages += messages.empty() ? message : std::string(", ") + message;
    });
    addPasses(optimizer, constants);
    spvtools::OptimizerOptions options;
    options.set_run_validator(false);  // glslang made the code, and the tests run under the validation layer
    std::vector<uint32_t> result;
    if (!optimizer.Run(code.data(), code.size(), &result, options)) refuse(spirv, "cannot be specialised: " + messages);
    return result;
}

}  // namespace

const DiskCache& kernelCache() {
    static const DiskCache cache{cacheFolder("kernels"), kCacheBytes};
    return cache;
}

std::vector<uint32_t> specialisedCode(const std::filesystem::path& spirv, std::span<const SpecConstant> constants,
                                      const DiskCache& cache) {
    const std::vector<std::byte> bytes = readFile(spirv);
    if (bytes.empty() || bytes.size() % sizeof(uint32_t) != 0) refuse(spirv, "is not SPIR-V");
    const Hash128 key = keyOf(bytes, constants);
    std::vector<uint32_t> code;
    if (loadCached(cache, kFormat, key, [&](std::span<const std::byte> stored) {
            code = wordsOf(stored);
            return true;
        }))
        return code;
    code = specialise(spirv, wordsOf(bytes), constants);
    storeCached(cache, kFormat, key, std::as_bytes(std::span(code)));
    return code;
}

}  // namespace raylab
