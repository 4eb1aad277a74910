#pragma once

#include "core/numbers/sample_sequence.hpp"
#include "simd/kernel/shade/formulas.hpp"
#include "simd/kernel/shade/optics.hpp"
#include "simd/kernel/shade/patterns.hpp"
#include "simd/units/kernels.hpp"

namespace raylane::simd {

/// The shading formula of core::Material, for packets of surfaces of one material. `Arch` has lanes
/// of doubles. Code for media and fog is compiled only into the kernels for scenes that have them.
template <class Arch, bool with_media, bool with_fog>
struct Shading {
    using F = Floats<Arch>;
    using M = Mask<Arch>;
    using V = Vectors<Arch>;
    static constexpr std::size_t lanes = F::size;

    static F load(const double* from) { return F::load_unaligned(from); }
    static V load(double* const (&from)[3], std::size_t i) {
        return {load(from[0] + i), load(from[1] + i), load(from[2] + i)};
    }
    static void store(const V& v, double* const (&to)[3], std::size_t i) {
        v.x.store_unaligned(to[0] + i);
        v.y.store_unaligned(to[1] + i);
        v.z.store_unaligned(to[2] + i);
    }
    static V product(const V& a, const V& b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }

    /// Reads a column at the places of a packet's lanes. The last packet repeats its last lane.
    struct Gather {
        std::uint32_t places[lanes];
        bool in_a_row;

        Gather(const std::uint32_t* numbers, std::size_t count) {
            for (std::size_t k = 0; k < lanes; ++k)
                places[k] = numbers[k < count ? k : count - 1];
            in_a_row = places[lanes - 1] - places[0] == lanes - 1;
            for (std::size_t k = 1; k < lanes; ++k)
                in_a_row &= places[k] > places[k - 1];
        }

        F operator()(const double* column) const {
            return in_a_row ? load(column + places[0]) : Lanes<Arch>::pick(column, places);
        }
        V operator()(const double* const (&columns)[3]) const {
            const F x = (*this)(columns[0]), y = (*this)(columns[1]), z = (*this)(columns[2]);
            return {x, y, z};
        }
    };

    static V point_of(const Gather& gather, const HitPaths& paths, const V& direction, const F& t) {
        const F way = paths.way == paths.t ? t : gather(paths.way);
        return mul_add<Arch>(way, direction, gather(paths.origin));
    }

    /// Writes the colours of a run whose pattern is a formula.
    [[gnu::noinline]] static void formula_colors(const Run& run, const std::uint32_t* numbers,
                                                 const HitPaths& paths, double* const (&own)[3]) {
        const core::FormulaProgram& program = *run.material->formula;
        Formulas<Arch> formulas(program);
        constexpr std::size_t chunk = Formulas<Arch>::chunk;
        for (std::size_t first = run.begin; first < run.end; first += chunk) {
            const std::size_t count = run.end - first < chunk ? run.end - first : chunk;
            for (std::size_t k = 0; k < count; k += lanes) {
                const Gather gather(numbers + first + k, count - k);
                const V point =
                    run.material->in_object_space
                        ? gather(paths.pattern)
                        : point_of(gather, paths, gather(paths.direction), gather(paths.t));
                formulas.set_point(k, point.x, point.y, point.z);
                for (int i = 0; i < 2 && program.needs_shape; ++i)
                    formulas.set(3 + i, k, gather(paths.on_shape[i]));
            }
            formulas.run(count);
            for (std::size_t k = 0; k < count; k += lanes)
                for (int i = 0; i < 3; ++i)
                    formulas.channel(i, k).store_unaligned(own[i] + first + k);
        }
    }

    static V own_color(const MaterialView& material, const Gather& gather, const HitPaths& paths,
                       const V& point, const Surfaces& surfaces, std::size_t i) {
        if (material.formula != nullptr) return load(surfaces.own, i);
        if (material.is_on_surface) return gather(paths.pattern);
        const V at = material.in_object_space ? gather(paths.pattern) : point;
        return Patterns<Arch>::color_at(material, at);
    }

    static void surfaces(const Run& run, const std::uint32_t* numbers, const HitPaths& paths,
                         [[maybe_unused]] const FogView& fog,
                         [[maybe_unused]] const MediumColumns* media, const Surfaces& surfaces) {
        const MaterialView& material = *run.material;
        if (material.formula != nullptr) formula_colors(run, numbers, paths, surfaces.own);
        for (std::size_t i = run.begin; i < run.end; i += lanes) {
            const Gather gather(numbers + i, run.end - i);
            const V direction = gather(paths.direction);
            const F t = gather(paths.t);
            const V point = point_of(gather, paths, direction, t);

            double sides[lanes];
            for (std::size_t k = 0; k < lanes; ++k)
                sides[k] = (paths.hit[gather.places[k]] & hit_entering) != 0 ? 1.0 : -1.0;
            const F side = load(sides);
            V flat = scaled(side, gather(paths.normal));
            V normal = flat;
            if (paths.shading_normal[0] != nullptr) {
                normal = scaled(side, gather(paths.shading_normal));
                normal = select<Arch>(dot<Arch>(normal, flat) < F(0.0), -normal, normal);
            }
            // Same as core::ReferenceTracer::surface_at.
            const M beside = dot<Arch>(flat, direction) > F(0x1p-20);
            flat = select<Arch>(beside, -direction, flat);
            normal = select<Arch>(beside, -direction, normal);

            V throughput = gather(paths.throughput);
            if constexpr (with_media)
                throughput = product(throughput, let_through(load(media->absorption, i), t));
            if (material.opacity < 1.0) {
                store(scaled(F(1.0 - material.opacity), throughput), surfaces.behind, i);
                throughput = scaled(F(material.opacity), throughput);
            }
            const V own = own_color(material, gather, paths, point, surfaces, i);
            V radiance = scaled(F(material.ambient), own);
            if constexpr (with_fog) {
                const F distance = paths.travelled != nullptr ? gather(paths.travelled) + t : t;
                F fogged = fog_fraction(fog, distance, point.z);
                if constexpr (with_media)
                    fogged = select(load(media->inside + i) > F(0.0), F(0.0), fogged);
                const V before = throughput;
                throughput = scaled(F(1.0) - fogged, before);
                radiance = product(throughput, radiance) +
                           product(scaled(fogged, before), broadcast_vector<Arch>(fog.color));
            } else {
                radiance = product(throughput, radiance);
            }

            store(point, surfaces.point, i);
            store(flat, surfaces.flat_normal, i);
            store(normal, surfaces.normal, i);
            store(direction, surfaces.direction, i);
            store(throughput, surfaces.throughput, i);
            store(own, surfaces.own, i);
            store(radiance, surfaces.radiance, i);
        }
    }

    static F fog_fraction(const FogView& fog, const F& distance, const F& z) {
        const F start(fog.start), range(fog.end - fog.start);
        switch (fog.kind) {
        case core::FogKind::none:
            return F(0.0);
        case core::FogKind::linear_z:
            return clamped((z - start) / range);
        case core::FogKind::linear:
            return clamped((distance - start) / range);
        case core::FogKind::exponential:
            return negated(core::Elementary<F>::expm1(negated(F(fog.density) * distance)));
        }
        __builtin_unreachable();
    }

    static F clamped(const F& value) { return min(max(value, F(0.0)), F(1.0)); }

    /// Returns the transmittance by Beer and Lambert's law.
    static V let_through(const V& absorption, const F& distance) {
        const M has_absorption =
            (absorption.x > F(0.0)) | (absorption.y > F(0.0)) | (absorption.z > F(0.0));
        if (Lanes<Arch>::bits(has_absorption) == 0) return {F(1.0), F(1.0), F(1.0)};
        const auto share = [&](const F& channel) {
            return core::Elementary<F>::exp(negated(channel) * distance);
        };
        return {share(absorption.x), share(absorption.y), share(absorption.z)};
    }

    static F numbers_from(std::size_t i) {
        double numbers[lanes];
        for (std::size_t k = 0; k < lanes; ++k)
            numbers[k] = static_cast<double>(i + k);
        return load(numbers);
    }

    static std::uint32_t present(std::size_t i, std::size_t end) {
        return end - i < lanes ? (1U << (end - i)) - 1 : (1U << lanes) - 1;
    }

    static void append(SpawnedRays& rays, std::uint32_t wanted, const V& origin, const V& direction,
                       const V& weight, const F& parent) {
        const std::size_t at = rays.count;
        const F* const values[] = {&origin.x,    &origin.y, &origin.z, &direction.x, &direction.y,
                                   &direction.z, &weight.x, &weight.y, &weight.z,    &parent};
        double* const columns[] = {
            rays.origin[0],    rays.origin[1], rays.origin[2], rays.direction[0], rays.direction[1],
            rays.direction[2], rays.weight[0], rays.weight[1], rays.weight[2],    rays.parent};
        for (int k = 0; k < 10; ++k)
            Lanes<Arch>::compress_store(columns[k] + at, *values[k], wanted);
        rays.count += static_cast<std::size_t>(__builtin_popcount(wanted));
    }

    static void light(const Run& run, const LightView& light, const Surfaces& surfaces,
                      SpawnedRays& shadows) {
        const MaterialView& material = *run.material;
        const F zero(0.0);
        for (std::size_t i = run.begin; i < run.end; i += lanes) {
            const V point = load(surfaces.point, i);
            V to_light = broadcast_vector<Arch>(light.to_light);
            F distance(__builtin_inf());
            if (light.is_point) {
                const V offset = broadcast_vector<Arch>(light.position) - point;
                distance = sqrt(squared_length<Arch>(offset));
                to_light = scaled(F(1.0) / distance, offset);
            }
            const M facing = dot<Arch>(load(surfaces.flat_normal, i), to_light) > zero;
            std::uint32_t wanted = Lanes<Arch>::bits(facing) & present(i, run.end);
            if (wanted == 0) continue;

            const V normal = load(surfaces.normal, i);
            const F cos_light = max(dot<Arch>(normal, to_light), zero);
            V share = scaled(F(material.diffuse) * cos_light, load(surfaces.own, i));
            if (material.specular > 0.0)
                share = share + highlight(material, normal, to_light, load(surfaces.direction, i));
            wanted &= Lanes<Arch>::bits((share.x > zero) | (share.y > zero) | (share.z > zero));
            const V weight = product(product(load(surfaces.throughput, i), share),
                                     broadcast_vector<Arch>(light.color));
            Lanes<Arch>::compress_store(shadows.distance + shadows.count, distance, wanted);
            append(shadows, wanted, point, to_light, weight, numbers_from(i));
        }
    }

    /// Returns the highlight of light from a direction.
    static V highlight(const MaterialView& material, const V& normal, const V& to_light,
                       const V& incident) {
        const F zero(0.0);
        if (material.highlight == core::Highlight::phong) {
            const F cosine =
                min(max(dot<Arch>(mirrored(incident, normal), to_light), zero), F(1.0));
            const F share =
                F(material.specular) * core::Elementary<F>::pow(cosine, F(material.exponent));
            return {share, share, share};
        }
        const V halfway = to_light - incident;
        const F squared = squared_length<Arch>(halfway);
        const F cosine = max(dot<Arch>(normal, halfway) / sqrt(squared), zero);
        const F share =
            select(squared > zero,
                   F(material.specular) *
                       core::Elementary<F>::pow(min(cosine, F(1.0)), F(material.exponent)),
                   zero);
        return {share, share, share};
    }

    /// Compilers vectorise this loop.
    static void light_points(std::size_t count, const std::uint64_t* keys,
                             const std::uint32_t* numbers, std::uint32_t more, double* u,
                             double* v) {
        for (std::size_t i = 0; i < count; ++i) {
            const core::SamplePoint point = core::shuffled_point(keys[i], numbers[i] + more);
            u[i] = static_cast<double>(point.x);
            v[i] = static_cast<double>(point.y);
        }
    }

    static void soft_light(const Run& run, const core::SoftLight& light, double part,
                           const double* us, const double* vs, const Surfaces& surfaces,
                           SpawnedRays& shadows) {
        const MaterialView& material = *run.material;
        const F zero(0.0);
        const bool is_sky = light.kind == core::LightKind::sky;
        const core::SoftLightSampler<F> sampler(light);
        for (std::size_t i = run.begin; i < run.end; i += lanes) {
            const V point = load(surfaces.point, i), normal = load(surfaces.normal, i);
            const core::LightSample<F> sample =
                sampler.sample({point.x, point.y, point.z}, {normal.x, normal.y, normal.z},
                               load(us + i), load(vs + i));
            const V to_light{sample.direction.x, sample.direction.y, sample.direction.z};
            const M facing = dot<Arch>(load(surfaces.flat_normal, i), to_light) > zero;
            std::uint32_t wanted = Lanes<Arch>::bits(facing) & present(i, run.end);
            if (wanted == 0) continue;

            const F cosine = is_sky ? F(1.0) : max(dot<Arch>(normal, to_light), zero);
            V share = scaled(F(material.diffuse) * cosine, load(surfaces.own, i));
            V radiance = broadcast_vector<Arch>(light.color);
            if (is_sky) {
                const V ground = broadcast_vector<Arch>(light.ground);
                radiance = mul_add<Arch>(sample.height, radiance - ground, ground);
            } else if (material.specular > 0.0) {
                share = share + highlight(material, normal, to_light, load(surfaces.direction, i));
            }
            const V weight = product(product(load(surfaces.throughput, i), share),
                                     scaled(F(part) * sample.share, radiance));
            wanted &= Lanes<Arch>::bits((weight.x > zero) | (weight.y > zero) | (weight.z > zero));
            if (wanted == 0) continue;
            Lanes<Arch>::compress_store(shadows.distance + shadows.count, sample.distance, wanted);
            append(shadows, wanted, point, to_light, weight, numbers_from(i));
        }
    }

    static V mirrored(const V& incident, const V& normal) {
        return mul_add<Arch>(F(-2.0) * dot<Arch>(incident, normal), normal, incident);
    }

    static void spawn(const Run& run, double min_weight,
                      [[maybe_unused]] const MediumColumns* media, const Surfaces& surfaces,
                      SpawnedRays& reflected, SpawnedRays& transmitted) {
        const MaterialView& material = *run.material;
        const F zero(0.0), one(1.0);
        const bool fresnel = material.reflection != core::Reflection::constant;
        for (std::size_t i = run.begin; i < run.end; i += lanes) {
            const std::uint32_t are_present = present(i, run.end);
            const V point = load(surfaces.point, i), direction = load(surfaces.direction, i);
            const V normal = load(surfaces.normal, i), flat = load(surfaces.flat_normal, i);
            const V throughput = load(surfaces.throughput, i);
            const F parent = numbers_from(i);

            F share(material.reflectivity);
            if (fresnel || material.transmits) {
                F before(1.0), behind(material.index);
                if constexpr (with_media) {
                    before = load(media->index_before + i);
                    behind = load(media->index_behind + i);
                }
                Refractions<Arch> refraction(direction, normal, before, behind);
                const M wrong_side =
                    ~refraction.total & (dot<Arch>(refraction.transmitted, flat) >= zero);
                if ((Lanes<Arch>::bits(wrong_side) & are_present) != 0)
                    refraction.replace(wrong_side,
                                       Refractions<Arch>(direction, flat, before, behind));
                share = refraction.reflectance(material, before, behind);
                if (material.transmits) {
                    const F let = (one - share) * F(material.transmission);
                    const V weight = scaled(let, throughput);
                    const std::uint32_t wanted =
                        Lanes<Arch>::bits(is_worth(weight, min_weight) & (let > zero)) &
                        are_present;
                    if (wanted != 0)
                        append(transmitted, wanted, point, normalized<Arch>(refraction.transmitted),
                               weight, parent);
                }
            }
            const V weight = scaled(share, throughput);
            const std::uint32_t wanted =
                Lanes<Arch>::bits(is_worth(weight, min_weight)) & are_present;
            if (wanted == 0) continue;
            V away = mirrored(direction, normal);
            const M wrong_side = dot<Arch>(away, flat) <= zero;
            if ((Lanes<Arch>::bits(wrong_side) & wanted) != 0)
                away = select<Arch>(wrong_side, mirrored(direction, flat), away);
            append(reflected, wanted, point, normalized<Arch>(away), weight, parent);
        }
    }

    static M is_worth(const V& weight, double min_weight) {
        const F most = max(max(weight.x, weight.y), weight.z);
        return (most > F(0.0)) & (most >= F(min_weight));
    }

    /// Kernels that do not depend on media or fog are instantiated once.
    static constexpr ShadeKernels table() {
        return {surfaces, Shading<Arch, false, false>::light,
                Shading<Arch, false, false>::light_points, Shading<Arch, false, false>::soft_light,
                Shading<Arch, with_media, false>::spawn};
    }
};

} // namespace raylane::simd
