// Every glTF extension this program knows, and the ATRIUM_ ones it defines. None of ours is ever in extensionsRequired.
//
// ATRIUM_shape        on a mesh: what its triangles stand for. "kind" and, by kind:
//     polygon   outer [x,y, x,y, ...], holes [[x,y, ...], ...]     plane z = 0, front +z, metres
//     box       size [x,y,z]                                        centred at the origin
//     sphere    radius
//     cylinder  radius, height, capped                              along y, centred
//     cone      baseRadius, topRadius, height, capped               along y, base at -height/2
//     disc      radius                                              plane z = 0, front +z
// ATRIUM_light        on a light of KHR_lights_punctual: angularDiameterDegrees (directional only), enabled,
//                     photometry (index of a profile of EXT_lights_ies: the light stands in for it, its intensity is the
//                     profile's peak as dimmed, and the node's own reference to the profile means the same lamp)
// ATRIUM_node         on a node: visible, locked, caustics {show "automatic" | "mesh" | "texture", texel (edge, metres),
//                     threshold (standard deviations)}: what was set by hand about caustics on its shape
// ATRIUM_camera       on a camera: exposure (stops from automatic exposure); infinite (an orthographic camera without far
//                     plane)
// ATRIUM_environment  on the root: skyRadiance [r,g,b] in cd/m2, the same from every direction
// ATRIUM_settings     on the root: quality "draft" | "normal" | "fine", seed, thresholds (those of the solver that were set
//                     by hand, see engine/scene/solver_thresholds.h)
// ATRIUM_solution     on the root of a .atrium file: bufferView, encoding "zstd", byteLength (decoded), hash (FNV-1a 64 of
// the
//                     decoded bytes, 16 hexadecimal digits). Disposable: a file without it, or with a damaged one, still
//                     opens.
// Fields that hold their default are left out.
#pragma once

#include <string_view>

namespace atrium::gltf {

inline constexpr char kShape[] = "ATRIUM_shape";
inline constexpr char kLight[] = "ATRIUM_light";
inline constexpr char kNode[] = "ATRIUM_node";
inline constexpr char kCamera[] = "ATRIUM_camera";
inline constexpr char kEnvironment[] = "ATRIUM_environment";
inline constexpr char kSettings[] = "ATRIUM_settings";
inline constexpr char kSolution[] = "ATRIUM_solution";

inline constexpr char kLightsPunctual[] = "KHR_lights_punctual";
inline constexpr char kLightsIes[] = "EXT_lights_ies";
inline constexpr char kEmissiveStrength[] = "KHR_materials_emissive_strength";
inline constexpr char kTransmission[] = "KHR_materials_transmission";
inline constexpr char kIor[] = "KHR_materials_ior";
inline constexpr char kVolume[] = "KHR_materials_volume";
inline constexpr char kSpecular[] = "KHR_materials_specular";
inline constexpr char kUnlit[] = "KHR_materials_unlit";
inline constexpr char kTextureTransform[] = "KHR_texture_transform";
inline constexpr char kQuantization[] = "KHR_mesh_quantization";
inline constexpr char kInstancing[] = "EXT_mesh_gpu_instancing";
inline constexpr char kNodeVisibility[] = "KHR_node_visibility";
inline constexpr char kWebp[] = "EXT_texture_webp";

/// Extensions that the reader interprets: a file may require them.
inline constexpr std::string_view kUnderstood[] = {kShape,          kLight,
                                                   kNode,           kCamera,
                                                   kEnvironment,    kSettings,
                                                   kSolution,       kLightsPunctual,
                                                   kLightsIes,      kEmissiveStrength,
                                                   kTransmission,   kIor,
                                                   kVolume,         kSpecular,
                                                   kUnlit,          kTextureTransform,
                                                   kQuantization,   kInstancing,
                                                   kNodeVisibility, kWebp};

} // namespace atrium::gltf
