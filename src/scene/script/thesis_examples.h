// The scripts of the thesis (document 003, appendix A), as they are printed there; for tests.
#pragma once

namespace parvis::scene {

inline constexpr const char* thesis_examples =
    R"(vdobject(cleanModels=0, file="car.pfb", camera="10 0 1 10 10 5.5 30 1", file="car2.iv", cameraFile="cameraIV.wrl", file="car3.wrl",cameraName="camera")

dayLight( lattitude=43.70, longitude=7.27,
standartMeridian=0, julianDay=130,
timeOfDay=16.00, turbidy=4 )

skyDome(texture="CapturedSky.jpg")

litVirtualObject() {
 object (file=duck.pfb, grab=1, wall=0)
 object (file=duck2.pfb, grab=1, wall=0)
}

%xpShadowMap()
)";

}  // namespace parvis::scene
