"""What UsdGeom, UsdShade, UsdLux and the UsdPreviewSurface specification 2.5 (OpenUSD 24.05) say.

Of the prims that relamp writes: every attribute that they may have, by its type. A type that begins
with "uniform " does not change in time.
"""

XFORMABLE = {"xformOp:transform": "matrix4d", "xformOpOrder": "uniform token[]"}

LIGHT = {
    **XFORMABLE,
    "inputs:color": "color3f",
    "inputs:colorTemperature": "float",
    "inputs:diffuse": "float",
    "inputs:enableColorTemperature": "bool",
    "inputs:exposure": "float",
    "inputs:intensity": "float",
    "inputs:normalize": "bool",
    "inputs:specular": "float",
}

ATTRIBUTES = {
    "Xform": XFORMABLE,
    "Scope": {},
    "Mesh": {
        **XFORMABLE,
        "doubleSided": "uniform bool",
        "extent": "float3[]",
        "faceVertexCounts": "int[]",
        "faceVertexIndices": "int[]",
        "normals": "normal3f[]",
        "orientation": "uniform token",
        "points": "point3f[]",
        "subdivisionScheme": "uniform token",
    },
    "Material": {"outputs:surface": "token"},
    "Shader": {"info:id": "uniform token"},
    "DistantLight": {**LIGHT, "inputs:angle": "float"},
    "DomeLight": {**LIGHT, "inputs:texture:file": "asset", "inputs:texture:format": "token"},
    "DiskLight": {**LIGHT, "inputs:radius": "float"},
    "RectLight": {**LIGHT, "inputs:width": "float", "inputs:height": "float"},
    "SphereLight": {**LIGHT, "inputs:radius": "float", "treatAsPoint": "bool"},
}

PRIMVARS = {
    "primvars:st": "texCoord2f[]",
    "primvars:displayColor": "color3f[]",
    "primvars:emission": "color3f[]",
}

SHADERS = {
    "UsdPreviewSurface": {
        "inputs:diffuseColor": "color3f",
        "inputs:emissiveColor": "color3f",
        "inputs:useSpecularWorkflow": "int",
        "inputs:specularColor": "color3f",
        "inputs:metallic": "float",
        "inputs:roughness": "float",
        "inputs:opacity": "float",
        "inputs:opacityThreshold": "float",
        "inputs:ior": "float",
        "outputs:surface": "token",
    },
    "UsdUVTexture": {
        "inputs:file": "asset",
        "inputs:st": "float2",
        "inputs:wrapS": "token",
        "inputs:wrapT": "token",
        "inputs:fallback": "float4",
        "inputs:scale": "float4",
        "inputs:bias": "float4",
        "inputs:sourceColorSpace": "token",
        "outputs:r": "float",
        "outputs:g": "float",
        "outputs:b": "float",
        "outputs:a": "float",
        "outputs:rgb": "float3",
    },
    "UsdPrimvarReader_float2": {"inputs:varname": "string", "outputs:result": "float2"},
    "UsdPrimvarReader_float3": {"inputs:varname": "string", "outputs:result": "float3"},
}

TOKENS = {
    "inputs:wrapS": {"black", "clamp", "repeat", "mirror", "useMetadata"},
    "inputs:wrapT": {"black", "clamp", "repeat", "mirror", "useMetadata"},
    "inputs:sourceColorSpace": {"raw", "sRGB", "auto"},
    "subdivisionScheme": {"catmullClark", "loop", "bilinear", "none"},
    "orientation": {"rightHanded", "leftHanded"},
    "info:id": set(SHADERS),
}
INTERPOLATIONS = {"constant", "uniform", "varying", "vertex", "faceVarying"}

# Metadata of prims and of the layer, as usda.py reads their values.
METADATA = {
    "active": bool,
    "apiSchemas": list,
    "customData": dict,
    "kind": str,
    "variantSets": str,
    "variants": dict,
}
LAYER_METADATA = {
    "customLayerData": dict,
    "defaultPrim": str,
    "doc": str,
    "metersPerUnit": float,
    "upAxis": str,
}

# Types that a connection may lead from, beside its own.
CONNECTABLE = {"color3f": {"float3"}, "float2": {"texCoord2f"}}

WIDTH = {"float2": 2, "texCoord2f": 2, "float3": 3, "color3f": 3, "float4": 4}
WIDTH |= {"normal3f": 3, "point3f": 3}
