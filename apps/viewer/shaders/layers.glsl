// Layers, in the order of Layer in layers.h, and the textures that they are read from.
const int kScan = 0;
const int kFlattened = 1;
const int kDirect = 2;
const int kIndirect = 3;
const int kShading = 4;
const int kAlbedo = 5;
const int kConfidence = 6;
const int kRelit = 7;
const int kGlance = 8; // relit, by the light at the vertices

const int kScanTexture = 0;
const int kFlattenedTexture = 1;
const int kDirectTexture = 2;
const int kIndirectTexture = 3;
const int kAlbedoTexture = 4;
const int kConfidenceTexture = 5;
const int kRelitTexture = 6;

const int kFirstTexture = kLayer == kFlattened    ? kFlattenedTexture
                          : kLayer == kDirect     ? kDirectTexture
                          : kLayer == kIndirect   ? kIndirectTexture
                          : kLayer == kShading    ? kDirectTexture
                          : kLayer == kAlbedo     ? kAlbedoTexture
                          : kLayer == kGlance     ? kAlbedoTexture
                          : kLayer == kConfidence ? kConfidenceTexture
                          : kLayer == kRelit      ? kRelitTexture
                                                  : kScanTexture;
