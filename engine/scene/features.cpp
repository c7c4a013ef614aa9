#include "engine/scene/features.h"

#include "engine/base/checks.h"

#include <algorithm>
#include <set>

namespace atrium {
namespace {

std::string counted(std::size_t n, const char* one, const char* many) {
    return std::to_string(n) + " " + (n == 1 ? one : many);
}
/// "'Lamp'" or, for something without a name, the given word.
std::string quoted(const std::string& name, const char* unnamed) { return name.empty() ? unnamed : "'" + name + "'"; }

/// What the shown nodes hold, counted once over the scene. Surfaces are parts of shown nodes.
struct Census {
    std::size_t surfaces = 0;
    std::size_t mirrors = 0;
    std::size_t glossy = 0;
    std::size_t glass = 0; ///< anything that transmits, thin or solid
    std::size_t solid_glass = 0;
    std::size_t cutouts = 0;
    std::size_t blended = 0;
    std::set<TextureId> textures;
    std::size_t suns = 0;
    std::string first_sun;
    std::size_t lamps = 0;    ///< point and spot lights that shine
    std::size_t measured = 0; ///< of these, with photometry
    std::size_t emitters = 0; ///< luminous surfaces
};

void count_textures(const Scene& scene, const Material& m, std::set<TextureId>& out) {
    const auto add = [&](const TextureRef& ref) {
        const Texture* texture = scene.textures.find(ref.texture);
        if (texture != nullptr && texture->image) {
            out.insert(ref.texture);
        }
    };
    add(m.base_color_texture);
    if (m.emits()) {
        add(m.emissive_texture);
    }
}

Census take_census(const Scene& scene) {
    Census c;
    scene.nodes.for_each([&](NodeId id, const Node& node) {
        const Shape* shape = scene.shapes.find(node.shape);
        const Light* light = scene.lights.find(node.light);
        if ((shape == nullptr && light == nullptr) || !scene.shown(id)) {
            return;
        }
        if (light != nullptr && light->enabled && light->kind == Light::Kind::Directional && light->intensity > 0.0F) {
            if (c.suns++ == 0) {
                c.first_sun = quoted(light->name.empty() ? node.name : light->name, "a directional light");
            }
        } else if (light != nullptr && light->enabled && light->intensity > 0.0F) {
            ++c.lamps;
            c.measured += light->photometry ? 1 : 0;
        }
        const std::size_t parts = shape != nullptr ? part_count(*shape) : 0;
        for (std::size_t part = 0; part < parts; ++part) {
            const Material* found = scene.material_of(node, part);
            const Material& m = found != nullptr ? *found : default_material();
            const MaterialKind kind = classify(m);
            ++c.surfaces;
            c.emitters += m.emits() ? 1 : 0;
            c.mirrors += kind == MaterialKind::Mirror ? 1 : 0;
            c.glossy += kind == MaterialKind::Glossy && m.roughness < kDullMetal ? 1 : 0;
            c.glass += m.transmission > 0.0F ? 1 : 0;
            c.solid_glass += kind == MaterialKind::DielectricSolid ? 1 : 0;
            c.cutouts += m.alpha_mode == Material::Alpha::Mask ? 1 : 0;
            c.blended += m.alpha_mode == Material::Alpha::Blend ? 1 : 0;
            count_textures(scene, m, c.textures);
        }
    });
    return c;
}

// "2 mirrors, 1 solid of glass": what bends or mirrors light.
std::string specular_surfaces(const Census& c) {
    std::string what;
    const auto add = [&](std::size_t n, const char* one, const char* many) {
        if (n > 0) {
            what += (what.empty() ? "" : ", ") + counted(n, one, many);
        }
    };
    add(c.mirrors, "mirror", "mirrors");
    add(c.glossy, "glossy metal", "glossy metals");
    add(c.glass - c.solid_glass, "sheet of glass", "sheets of glass");
    add(c.solid_glass, "solid of glass", "solids of glass");
    return what;
}

bool needs_particles(const Census& c) { return c.mirrors + c.glossy + c.glass > 0 && c.suns + c.lamps + c.emitters > 0; }

std::string particles_why(const Census& c) {
    if (c.mirrors + c.glossy + c.glass == 0) {
        return "There is no specular surface in the scene.";
    }
    if (c.suns + c.lamps + c.emitters == 0) {
        return "No lamp, sun or luminous surface shines on the scene's " + specular_surfaces(c) + ".";
    }
    return "Light of lamps and suns goes on over " + specular_surfaces(c) + ".";
}

std::string refraction_why(const Census& c) {
    if (c.solid_glass > 0) {
        return "Light is bent by " + counted(c.solid_glass, "solid of glass", "solids of glass") +
               "; flat panes let it straight.";
    }
    return c.glass > 0 ? "All glass is in thin sheets, which light crosses unbent." : "There is no glass in the scene.";
}

std::string specular_view_why(const Census& c) {
    std::string what;
    const auto add = [&](std::size_t n, const char* one, const char* many) {
        if (n > 0) {
            what += (what.empty() ? "" : ", ") + counted(n, one, many);
        }
    };
    add(c.mirrors, "mirror", "mirrors");
    add(c.glossy, "glossy metal", "glossy metals");
    add(c.glass, "glass surface", "glass surfaces");
    return what.empty() ? "There is no mirror, metal or glass in the scene."
                        : "Stills trace mirrors and glass: " + what + ".";
}

std::string transmittance_why(const Census& c) {
    std::string out;
    if (c.glass > 0) {
        out = "Light passes " + counted(c.glass, "glass surface", "glass surfaces") + " straight";
    }
    if (c.blended > 0) {
        out += (out.empty() ? "Light passes " : " and ") + counted(c.blended, "blended surface", "blended surfaces") +
               " in proportion to its alpha";
    }
    return out.empty() ? "Every surface is opaque." : out + ".";
}

std::string direct_layer_why(const Census& c, bool sky) {
    std::string what;
    const auto add = [&](std::size_t n, const char* one, const char* many) {
        if (n > 0) {
            what += (what.empty() ? "" : ", ") + counted(n, one, many);
        }
    };
    add(c.suns, "sun", "suns");
    add(c.lamps, "lamp", "lamps");
    add(c.emitters, "luminous surface", "luminous surfaces");
    if (sky) {
        what += what.empty() ? "the sky" : ", the sky";
    }
    return what.empty() ? "Nothing in the scene gives light."
                        : "Light straight from its source is kept per texel: " + what + ".";
}

std::string sky_why(const Scene& scene) {
    const float radiance = luminance(scene.environment.sky_radiance);
    return radiance > 0.0F ? "The sky shines with " + std::to_string(std::lround(std::fmax(radiance, 1.0F))) + " cd/m2."
                           : "The environment is black.";
}

} // namespace

std::vector<Feature> scene_features(const Scene& scene) {
    const Census c = take_census(scene);
    const bool specular = c.mirrors + c.glossy + c.glass > 0;
    const bool sky = max_component(scene.environment.sky_radiance) > 0.0F;
    std::string sun = "There is no directional light in the scene.";
    if (c.suns == 1) {
        sun = "The directional light " + c.first_sun + " shines.";
    } else if (c.suns > 1) {
        sun =
            counted(c.suns, "directional light shines", "directional lights shine") + ", the first is " + c.first_sun + ".";
    }
    return {
        {"particles", needs_particles(c), particles_why(c)},
        {"caustic_textures", needs_particles(c),
         needs_particles(c) ? "Made where what particles bring has finer detail than the mesh." : particles_why(c)},
        {"octree", false, needs_particles(c) ? "Nothing is selected to move." : particles_why(c)},
        {"refraction", c.solid_glass > 0, refraction_why(c)},
        {"glossy", c.glossy > 0,
         c.glossy > 0
             ? "Light is scattered about the mirror direction by " + counted(c.glossy, "glossy metal", "glossy metals") + "."
             : "There is no glossy metal in the scene."},
        {"sun", c.suns > 0, sun},
        {"sky", sky, sky_why(scene)},
        {"textures", !c.textures.empty(),
         c.textures.empty() ? "No shown surface has a texture that changes light."
                            : "Surfaces are coloured by " + counted(c.textures.size(), "texture", "textures") + "."},
        {"direct_layer", sky || c.suns + c.lamps + c.emitters > 0, direct_layer_why(c, sky)},
        {"specular_view", specular, specular_view_why(c)},
        {"transmittance", c.glass + c.blended > 0, transmittance_why(c)},
        {"alpha_cutouts", c.cutouts > 0,
         c.cutouts == 0 ? "No surface is cut out by its alpha."
                        : counted(c.cutouts, "surface is", "surfaces are") + " cut out by alpha: light passes the holes."},
        {"photometry", c.measured > 0,
         c.measured == 0 ? "No lamp has a photometric file."
                         : counted(c.measured, "lamp shines", "lamps shine") + " as photometric files say."},
    };
}

const Feature& find_feature(const std::vector<Feature>& features, const std::string& name) {
    const auto at = std::find_if(features.begin(), features.end(), [&](const Feature& f) { return f.name == name; });
    ATRIUM_CHECK(at != features.end());
    return *at;
}

} // namespace atrium
