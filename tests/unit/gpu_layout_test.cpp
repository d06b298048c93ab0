#include <array>
#include <bit>

#include "engine/gpu/buffer.h"
#include "engine/gpu/pipeline.h"
#include "shaders/shared/bindings.h"
#include "shaders/shared/denoise.h"
#include "shaders/shared/scene.h"
#include "shaders/shared/wavefront.h"
#include "tests/support/gpu_test.h"
#include "tests/support/paths.h"

namespace raylab::support {
namespace {

/// Gives each scalar a number of its own and keeps the bits in the order of assignment, which is the order of
/// declaration and that of tests/shaders/layout.comp.
class Numbering {
public:
    template <class... Fields>
    void assign(Fields&... fields) {
        (number(fields), ...);
    }
    const std::vector<uint32_t>& bits() const { return bits_; }

private:
    void number(uint32_t& value) {
        value = static_cast<uint32_t>(bits_.size()) + 1000u;
        bits_.push_back(value);
    }
    void number(float& value) {
        value = static_cast<float>(bits_.size()) + 1000.5f;
        bits_.push_back(std::bit_cast<uint32_t>(value));
    }
    void number(glm::vec3& value) { assign(value.x, value.y, value.z); }
    void number(glm::vec4& value) { assign(value.x, value.y, value.z, value.w); }

    std::vector<uint32_t> bits_;
};

struct Structs {
    shared::FrameParams frame;
    shared::FilmPixel film;
    shared::RenderPush push;
    shared::RayData ray;
    shared::HitData hit;
    shared::RayCounts counts;
    shared::RaysPush raysPush;
    shared::TraceTriangle traceTriangle;
    shared::TraceInstance traceInstance;
    shared::TraceQuadric traceQuadric;
    std::array<shared::InstanceData, 2> instances{};  ///< the second is read, lest a stride of 0 go unseen
    shared::MotionData motion;
    std::array<shared::MotionData, 2> still{};  ///< which the instance's flags may have the kernel read
    shared::TriangleData triangle;
    shared::VertexData vertex;
    shared::QuadricData quadric;
    std::array<shared::MaterialData, 2> materials{};
    std::array<shared::LobeData, 2> lobes{};
    std::array<shared::LobeTextureData, 2> lobeTextures{};
    std::array<shared::PhongData, 2> phong{};
    shared::TextureData texture;
    shared::EmissiveData emissive;
    std::array<shared::LightNodeData, 2> lightNodes{};
    shared::PunctualData punctual;
    shared::WavefrontPush wavefrontPush;
    shared::DenoisePush denoisePush;
};

void numberFrame(Numbering& n, shared::FrameParams& f) {
    n.assign(f.cameraPosition, f.pixelSpread, f.cameraRight, f.width, f.cameraUp, f.height, f.cameraForward, f.seed);
    n.assign(f.tilesPerRow, f.maxDepth, f.rouletteDepth, f.traceInstanceCount, f.emissiveCount, f.punctualCount);
    n.assign(f.environmentWidth, f.environmentHeight, f.shareEmissive, f.sharePunctual, f.shareEnvironment);
    n.assign(f.emissiveTotal, f.environmentConstant, f.sceneDiagonal, f.gridOrigin, f.root, f.gridStep, f.hasUpperTree);
    n.assign(f.sampleCount, f.strataWidth, f.filterRadius, f.lensRadius, f.focusDistance, f.clampRadiance);
    n.assign(f.mirrorAlpha, f.aoDistance, f.aoRays, f.aoShare, f.shapedCount, f.shutter, f.lightGridOrigin, f.sunDiscCount);
    n.assign(f.lightGridStep, f.inverseThroughputEnd, f.endPosition, f.padding1, f.endRight, f.padding2, f.endUp, f.padding3);
    n.assign(f.endForward, f.padding4, f.ambient, f.threshold);
}

void numberBuffers(Numbering& n, Structs& s) {
    n.assign(s.film.sumHi, s.film.count, s.film.sumLo, s.film.nonFinite, s.film.squareHi, s.film.rays);
    n.assign(s.film.squareLo, s.film.clamped);
    n.assign(s.push.firstTile, s.push.firstRow, s.push.firstSample, s.push.sampleCount, s.push.firstLane, s.push.laneCount);
    n.assign(s.ray.origin, s.ray.tMin, s.ray.direction, s.ray.tMax);
    n.assign(s.hit.t, s.hit.u, s.hit.v, s.hit.instance, s.hit.primitive);
    n.assign(s.counts.steps, s.counts.nodes, s.counts.boxesTested, s.counts.boxesHit, s.counts.primitivesTested);
    n.assign(s.counts.primitivesHit, s.counts.instances, s.counts.stackHigh);
    n.assign(s.raysPush.count, s.raysPush.anyHit);
}

void numberTraversal(Numbering& n, shared::TraceTriangle& t, shared::TraceInstance& i, shared::TraceQuadric& q) {
    n.assign(t.p0, t.instance, t.p1, t.primitive, t.p2, t.opacity);
    n.assign(i.worldToObject0, i.worldToObject1, i.worldToObject2, i.gridOrigin, i.root, i.gridStep, i.instance);
    n.assign(i.firstSlot, i.slotCount, i.opaqueSlots, i.triangleSlots);
    n.assign(q.toCanonical0, q.toCanonical1, q.toCanonical2, q.zz, q.z, q.constant, q.clipLow, q.clipHigh);
    n.assign(q.isEllipsoid, q.padding0, q.padding1);
}

void numberGeometry(Numbering& n, shared::InstanceData& i, shared::MotionData& m, shared::TriangleData& t, shared::VertexData& v,
                    shared::QuadricData& q) {
    n.assign(i.objectToWorld0, i.objectToWorld1, i.objectToWorld2, i.firstPrimitive, i.material, i.flags, i.firstTrail);
    n.assign(m.endToWorld0, m.endToWorld1, m.endToWorld2);
    n.assign(t.v0, t.v1, t.v2, t.padding);
    n.assign(v.position, v.normal, v.u, v.v, v.tangent, v.padding);
    n.assign(q.radii, q.zz, q.z, q.constant, q.height, q.isEllipsoid);
}

void numberMaterials(Numbering& n, shared::MaterialData& m, shared::LobeData& l, shared::LobeTextureData& x,
                     shared::PhongData& p, shared::TextureData& t) {
    n.assign(m.baseColor, m.alpha, m.emission, m.alphaCutoff, m.metallic, m.roughness, m.transmission, m.ior);
    n.assign(m.specular, m.normalScale, m.emissionWeight, m.flags, m.baseColorTexture, m.metallicRoughnessTexture);
    n.assign(m.normalTexture, m.emissionTexture);
    n.assign(l.specularColor, l.clearcoat, l.sheenColor, l.sheenRoughness, l.absorption, l.clearcoatAlpha);
    n.assign(l.anisotropy, l.tangentCos, l.tangentSin, l.priority);
    n.assign(x.clearcoat, x.clearcoatRoughness, x.clearcoatNormal, x.clearcoatNormalScale, x.sheenColor);
    n.assign(x.sheenRoughness, x.anisotropy, x.specular, x.specularColor, x.transmission);
    n.assign(p.diffuse, p.exponent, p.specular, p.reflection, p.mirror, p.ior, p.tint, p.isGiven);
    n.assign(t.firstTexel, t.width, t.height, t.flags);
}

void numberLights(Numbering& n, shared::EmissiveData& e, shared::LightNodeData& l, shared::PunctualData& p) {
    n.assign(e.p0, e.threshold, e.edge1, e.alias, e.edge2, e.material, e.instance, e.primitive, e.frontSign, e.padding);
    n.assign(l.loXY, l.loZhiX, l.hiYZ, l.axis, l.power, l.cosines, l.reference, l.flags);
    n.assign(p.position, p.kind, p.direction, p.threshold, p.intensity, p.alias, p.shape, p.probability);
}

void numberWavefront(Numbering& n, shared::WavefrontPush& p) {
    n.assign(p.slice.firstTile, p.slice.firstRow, p.slice.firstSample, p.slice.sampleCount, p.slice.firstLane);
    n.assign(p.slice.laneCount, p.capacity, p.lanes, p.cellOrigin, p.round, p.cellScale, p.pathsPerLane);
}

void numberDenoise(Numbering& n, shared::DenoisePush& p) {
    n.assign(p.width, p.height, p.firstPixel, p.pixelCount, p.task, p.spacing);
}

std::vector<uint32_t> numberAll(Structs& s) {
    Numbering numbering;
    numberFrame(numbering, s.frame);
    numberBuffers(numbering, s);
    numberTraversal(numbering, s.traceTriangle, s.traceInstance, s.traceQuadric);
    numberGeometry(numbering, s.instances[1], s.motion, s.triangle, s.vertex, s.quadric);
    numberMaterials(numbering, s.materials[1], s.lobes[1], s.lobeTextures[1], s.phong[1], s.texture);
    numberLights(numbering, s.emissive, s.lightNodes[1], s.punctual);
    numberWavefront(numbering, s.wavefrontPush);
    numberDenoise(numbering, s.denoisePush);
    return numbering.bits();
}

/// The buffers of the kernel and their bindings, in the order of addition.
class Inputs {
public:
    explicit Inputs(Device& device) : device_(device) {}

    template <class T>
    void buffer(uint32_t binding, const T& value, VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER) {
        const VkBufferUsageFlags usage = type == VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER ? VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT
                                                                                   : VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
        infos_.push_back({binding, type});
        buffers_.push_back(makeDeviceBuffer(device_, "layout", std::as_bytes(std::span(&value, 1)),
                                            usage | VK_BUFFER_USAGE_TRANSFER_SRC_BIT));
    }
    template <class T>
    void texels(uint32_t binding, const T& values) {
        texelBindings_.push_back(binding);
        texelBuffers_.push_back(
            makeTexelBuffer(device_, "layout", std::as_bytes(std::span(values)), VK_FORMAT_R32G32B32A32_UINT, 16));
    }
    KernelLayout bind(uint32_t pushBytes) const {
        std::vector<BindingInfo> all = infos_;
        for (const uint32_t binding : texelBindings_) all.push_back({binding, VK_DESCRIPTOR_TYPE_UNIFORM_TEXEL_BUFFER});
        KernelLayout layout(device_, all, pushBytes);
        for (size_t i = 0; i < infos_.size(); ++i)
            bindBuffer(device_, layout, infos_[i], buffers_[i].get(), 0, buffers_[i].sizeBytes());
        for (size_t i = 0; i < texelBindings_.size(); ++i)
            bindTexelView(device_, layout, texelBindings_[i], texelBuffers_[i].view.get());
        return layout;
    }
    const Buffer& last() const { return buffers_.back(); }

private:
    Device& device_;
    std::vector<BindingInfo> infos_;
    std::vector<Buffer> buffers_;
    std::vector<uint32_t> texelBindings_;
    std::vector<TexelBuffer> texelBuffers_;
};

using Layout = GpuTest;

TEST_F(Layout, EveryFieldIsWhereBothLanguagesExpectIt) {
    Structs s{};
    const std::vector<uint32_t> expected = numberAll(s);
    std::array<uint32_t, 512> result{};
    ASSERT_LT(expected.size(), result.size());
    Inputs inputs(device_);
    inputs.buffer(shared::kBindFrame, s.frame, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER);
    inputs.buffer(shared::kBindFilm, s.film);
    inputs.buffer(shared::kBindRays, s.ray);
    inputs.buffer(shared::kBindHits, s.hit);
    inputs.buffer(40, s.raysPush);
    inputs.buffer(41, s.traceTriangle);
    inputs.buffer(42, s.traceInstance);
    inputs.buffer(43, s.triangle);
    inputs.buffer(44, s.vertex);
    inputs.buffer(45, s.texture);
    inputs.buffer(46, s.emissive);
    inputs.buffer(47, s.punctual);
    inputs.buffer(shared::kBindCounts, s.counts);
    inputs.buffer(49, s.traceQuadric);
    inputs.buffer(50, s.quadric);
    inputs.buffer(51, s.wavefrontPush);
    inputs.buffer(52, s.motion);
    inputs.buffer(53, s.denoisePush);
    inputs.buffer(48, result);
    inputs.texels(shared::kBindInstances, s.instances);
    inputs.texels(shared::kBindMotion, s.still);
    inputs.texels(shared::kBindMaterials, s.materials);
    inputs.texels(shared::kBindLobes, s.lobes);
    inputs.texels(shared::kBindLobeTextures, s.lobeTextures);
    inputs.texels(shared::kBindPhong, s.phong);
    inputs.texels(shared::kBindLightNodes, s.lightNodes);
    const KernelLayout layout = inputs.bind(sizeof(shared::RenderPush));
    const Kernel kernel = makeComputeKernel(device_, layout, support::binaryFolder() / "tests/layout.comp.spv", {});
    device_.run("layout", [&](VkCommandBuffer commands) {
        launch(device_, commands, layout, kernel, {}, &s.push, 1);
    });
    download(device_, inputs.last(), std::as_writable_bytes(std::span(result)));
    for (size_t i = 0; i < expected.size(); ++i) EXPECT_EQ(result[i], expected[i]) << "scalar " << i;
    EXPECT_EQ(result[expected.size()], 0u) << "the kernel knows more fields";
}

}  // namespace
}  // namespace raylab::support
