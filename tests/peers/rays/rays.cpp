// Times Embree (3 or 4) and tinybvh with the rays that trigon's example `rays` wrote; see its first lines for the files
// and for the form of the output.
//
// usage: rays FOLDER REPETITIONS SCENE PEER
//
// PEER is embree, embree-robust (RTC_SCENE_FLAG_ROBUST), embree-high (RTC_BUILD_QUALITY_HIGH: with spatial splits), tinybvh
// (BVH8_CPU, binned) or tinybvh-high (BVH8_CPU, spatial splits). Embree also follows packets of eight rays where rays are
// coherent; those lines have the peer's name and "-packets". EMBREE_ISA sets Embree's instructions; avx2 unless set.
//
// Every program builds what its calls need from the same seven numbers of each ray within the timed loop. Three numbers
// follow the hits in each line: rays that only trigon says hit, rays that only the peer says hit, and rays of which both
// say that they hit, but whose distances differ by more than 1/10,000.
#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif
#define NO_THREADED_BUILDS
#define TINYBVH_IMPLEMENTATION
#include "tiny_bvh.h"
#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>
#include <pmmintrin.h>

struct Triangle { float corners[3][3]; };
struct Query { float origin[3], direction[3], end; };
struct Hit { uint32_t triangle; float distance; };
constexpr uint32_t MISS = ~0u;
// As in the example.
constexpr size_t BLOCK = 512;
using Follow = std::function<void(const Query*, Hit*, size_t)>;

static double milliseconds() {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

template <class T> static std::vector<T> load(const std::string& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) { fprintf(stderr, "%s is missing\n", path.c_str()); exit(1); }
    std::vector<T> items(size_t(file.tellg()) / sizeof(T));
    file.seekg(0);
    file.read(reinterpret_cast<char*>(items.data()), std::streamsize(items.size() * sizeof(T)));
    return items;
}

struct Embree {
    RTCScene scene;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments closest;
    RTCOccludedArguments any;
    void prepare() {
        rtcInitIntersectArguments(&closest);
        rtcInitOccludedArguments(&any);
        closest.flags = any.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    }
    void intersect(RTCRayHit& ray) { rtcIntersect1(scene, &ray); }
    void occluded(RTCRay& ray) { rtcOccluded1(scene, &ray); }
    void intersect(const int* valid, RTCRayHit8& rays) { rtcIntersect8(valid, scene, &rays, &closest); }
    void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene, &rays, &any); }
#else
    RTCIntersectContext single, coherent;
    void prepare() {
        rtcInitIntersectContext(&single);
        rtcInitIntersectContext(&coherent);
        coherent.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    }
    void intersect(RTCRayHit& ray) { rtcIntersect1(scene, &single, &ray); }
    void occluded(RTCRay& ray) { rtcOccluded1(scene, &single, &ray); }
    void intersect(const int* valid, RTCRayHit8& rays) { rtcIntersect8(valid, scene, &coherent, &rays); }
    void occluded(const int* valid, RTCRay8& rays) { rtcOccluded8(valid, scene, &coherent, &rays); }
#endif

    Embree(const std::vector<Triangle>& triangles, const std::string& peer) {
        const char* isa = getenv("EMBREE_ISA");
        const std::string options = "threads=1,isa=" + std::string(isa ? isa : "avx2");
        RTCDevice device = rtcNewDevice(options.c_str());
        if (!device) { fprintf(stderr, "Embree refuses %s\n", options.c_str()); exit(1); }
        scene = rtcNewScene(device);
        if (peer == "embree-robust") rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
        if (peer == "embree-high") rtcSetSceneBuildQuality(scene, RTC_BUILD_QUALITY_HIGH);
        RTCGeometry mesh = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
        const size_t count = triangles.size();
        void* corners = rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, 3 * count);
        memcpy(corners, triangles.data(), count * sizeof(Triangle));
        auto* indices = static_cast<uint32_t*>(
            rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, count));
        for (uint32_t i = 0; i < 3 * count; i++) indices[i] = i;
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene, mesh);
        rtcReleaseGeometry(mesh);
        prepare();
        rtcCommitScene(scene);
        if (rtcGetDeviceError(device) != RTC_ERROR_NONE) { fprintf(stderr, "Embree reports an error\n"); exit(1); }
    }

    static void set(RTCRay& ray, const Query& query) {
        ray.org_x = query.origin[0], ray.org_y = query.origin[1], ray.org_z = query.origin[2];
        ray.dir_x = query.direction[0], ray.dir_y = query.direction[1], ray.dir_z = query.direction[2];
        ray.tnear = 0, ray.tfar = query.end, ray.time = 0, ray.mask = ~0u, ray.flags = 0;
    }

    void set(RTCRay8& rays, int* valid, const Query* queries, size_t count) {
        for (size_t lane = 0; lane < 8; lane++) {
            const Query& query = queries[std::min(lane, count - 1)];
            rays.org_x[lane] = query.origin[0], rays.org_y[lane] = query.origin[1], rays.org_z[lane] = query.origin[2];
            rays.dir_x[lane] = query.direction[0], rays.dir_y[lane] = query.direction[1];
            rays.dir_z[lane] = query.direction[2], rays.tnear[lane] = 0, rays.tfar[lane] = query.end;
            rays.time[lane] = 0, rays.mask[lane] = ~0u, rays.flags[lane] = 0;
            valid[lane] = lane < count ? -1 : 0;
        }
    }

    Follow follow(bool any, bool packets) {
        if (any && packets) return [this](const Query* queries, Hit* hits, size_t count) {
            alignas(32) int valid[8];
            RTCRay8 rays;
            for (size_t i = 0; i < count; i += 8) {
                set(rays, valid, queries + i, count - i);
                occluded(valid, rays);
                for (size_t j = i; j < std::min(i + 8, count); j++) hits[j] = {rays.tfar[j - i] < 0 ? 0 : MISS, 0};
            }
        };
        if (packets) return [this](const Query* queries, Hit* hits, size_t count) {
            alignas(32) int valid[8];
            RTCRayHit8 rays;
            for (size_t i = 0; i < count; i += 8) {
                set(rays.ray, valid, queries + i, count - i);
                for (auto& geometry : rays.hit.geomID) geometry = RTC_INVALID_GEOMETRY_ID;
                intersect(valid, rays);
                for (size_t j = i; j < std::min(i + 8, count); j++) {
                    const bool hit = rays.hit.geomID[j - i] != RTC_INVALID_GEOMETRY_ID;
                    hits[j] = {hit ? rays.hit.primID[j - i] : MISS, rays.ray.tfar[j - i]};
                }
            }
        };
        if (any) return [this](const Query* queries, Hit* hits, size_t count) {
            RTCRay ray;
            for (size_t i = 0; i < count; i++) {
                set(ray, queries[i]);
                occluded(ray);
                hits[i] = {ray.tfar < 0 ? 0 : MISS, 0};
            }
        };
        return [this](const Query* queries, Hit* hits, size_t count) {
            RTCRayHit ray;
            for (size_t i = 0; i < count; i++) {
                set(ray.ray, queries[i]);
                ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                intersect(ray);
                hits[i] = {ray.hit.geomID != RTC_INVALID_GEOMETRY_ID ? ray.hit.primID : MISS, ray.ray.tfar};
            }
        };
    }
};

struct Tiny {
    std::vector<tinybvh::bvhvec4> corners;
    tinybvh::BVH8_CPU bvh;

    explicit Tiny(const std::vector<Triangle>& triangles) {
        for (const Triangle& triangle : triangles)
            for (const auto& corner : triangle.corners) corners.emplace_back(corner[0], corner[1], corner[2], 0.0f);
    }
    void build(bool high) {
        const auto count = uint32_t(corners.size() / 3);
        if (high) bvh.BuildHQ(corners.data(), count); else bvh.Build(corners.data(), count);
    }

    static void set(tinybvh::Ray& ray, const Query& query) {
        ray.O = {query.origin[0], query.origin[1], query.origin[2]};
        ray.D = {query.direction[0], query.direction[1], query.direction[2]};
        ray.rD = tinybvh::tinybvh_rcp(ray.D);
        ray.hit.t = std::min(query.end, BVH_FAR);
    }

    Follow follow(bool any) {
        if (any) return [this](const Query* queries, Hit* hits, size_t count) {
            tinybvh::Ray ray;
            for (size_t i = 0; i < count; i++) {
                set(ray, queries[i]);
                hits[i] = {bvh.IsOccluded(ray) ? 0 : MISS, 0};
            }
        };
        return [this](const Query* queries, Hit* hits, size_t count) {
            tinybvh::Ray ray;
            for (size_t i = 0; i < count; i++) {
                set(ray, queries[i]);
                bvh.Intersect(ray);
                hits[i] = {ray.hit.t < BVH_FAR ? ray.hit.prim : MISS, ray.hit.t};
            }
        };
    }
};

static double median(std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    return times[times.size() / 2];
}

// The sum over all blocks of the median of each one's times.
static double time(const Follow& follow, const std::vector<Query>& queries, std::vector<Hit>& hits, int repetitions) {
    std::vector<std::vector<double>> times((queries.size() + BLOCK - 1) / BLOCK);
    for (int repetition = 0; repetition < repetitions; repetition++)
        for (size_t block = 0; block < times.size(); block++) {
            const size_t first = block * BLOCK;
            const double start = milliseconds();
            follow(&queries[first], &hits[first], std::min(BLOCK, queries.size() - first));
            times[block].push_back(milliseconds() - start);
        }
    double sum = 0;
    for (auto& each : times) sum += median(each);
    return sum;
}

static void report(const std::string& begin, double ms, const std::vector<Hit>& hits, const std::vector<Hit>& ours) {
    size_t count = 0, only_ours = 0, only_theirs = 0, other = 0;
    for (size_t i = 0; i < hits.size(); i++) {
        const bool hit = hits[i].triangle != MISS, our_hit = ours[i].triangle != MISS;
        count += hit, only_ours += our_hit && !hit, only_theirs += hit && !our_hit;
        const float distance = ours[i].distance;
        other += hit && our_hit && std::abs(hits[i].distance - distance) > 1e-4f * distance;
    }
    printf("%s,%.4f,%zu,%zu,%zu,%zu\n", begin.c_str(), double(hits.size()) / ms / 1e3, count, only_ours, only_theirs, other);
}

int main(int count, char** words) {
    if (count != 5) { fprintf(stderr, "usage: rays FOLDER REPETITIONS SCENE PEER\n"); return 2; }
    const std::string folder = words[1], scene = words[3], peer = words[4];
    const int repetitions = std::max(1, atoi(words[2]));
    // As Embree's documentation asks for.
    _MM_SET_FLUSH_ZERO_MODE(_MM_FLUSH_ZERO_ON);
    _MM_SET_DENORMALS_ZERO_MODE(_MM_DENORMALS_ZERO_ON);
    const auto triangles = load<Triangle>(folder + "/" + scene + ".triangles");
    const bool is_tiny = peer.rfind("tinybvh", 0) == 0;
    Tiny tiny(is_tiny ? triangles : std::vector<Triangle>());
    const double start = milliseconds();
    if (is_tiny) tiny.build(peer == "tinybvh-high");
    Embree* embree = is_tiny ? nullptr : new Embree(triangles, peer);
    printf("%s,%s,build,%.2f\n", peer.c_str(), scene.c_str(), milliseconds() - start);

    std::ifstream sets(folder + "/sets");
    for (std::string of, set, kind; sets >> of >> set >> kind;) {
        if (of != scene) continue;
        const auto queries = load<Query>(folder + "/" + scene + "-" + set + ".rays");
        const auto ours = load<Hit>(folder + "/" + scene + "-" + set + ".hits");
        std::vector<Hit> hits(queries.size());
        const bool any = kind == "any", coherent = set == "primary" || set == "shadow";
        const std::string end = "," + scene + "," + set;
        const Follow single = is_tiny ? tiny.follow(any) : embree->follow(any, false);
        report(peer + end, time(single, queries, hits, repetitions), hits, ours);
        if (is_tiny || !coherent) continue;
        report(peer + "-packets" + end, time(embree->follow(any, true), queries, hits, repetitions), hits, ours);
    }
}
