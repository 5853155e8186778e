<?xml version="1.0" encoding="UTF-8"?>
<CityModel xmlns="http://www.opengis.net/citygml/3.0" xmlns:con="http://www.opengis.net/citygml/construction/3.0" xmlns:bldg="http://www.opengis.net/citygml/building/3.0" xmlns:gen="http://www.opengis.net/citygml/generics/3.0" xmlns:app="http://www.opengis.net/citygml/appearance/3.0" xmlns:gml="http://www.opengis.net/gml/3.2">
<appearanceMember><app:Appearance><app:theme>day</app:theme><app:surfaceData><app:ParameterizedTexture>
<app:imageURI>wall.jpg</app:imageURI><app:textureParameterization><app:TextureAssociation><app:target>#p</app:target>
<app:textureParameterization><app:TexCoordList><app:textureCoordinates>0 0 1 0 1 1 0 1 0 0</app:textureCoordinates>
<app:ring>#r</app:ring></app:TexCoordList></app:textureParameterization></app:TextureAssociation>
</app:textureParameterization></app:ParameterizedTexture></app:surfaceData></app:Appearance></appearanceMember>
<cityObjectMember><bldg:Building gml:id="house"><genericAttribute><gen:IntAttribute><gen:name>a</gen:name>
<gen:value>4</gen:value></gen:IntAttribute></genericAttribute><boundary><con:WallSurface gml:id="w"><lod3MultiSurface>
<gml:MultiSurface><gml:surfaceMember><gml:Polygon gml:id="p"><gml:exterior><gml:LinearRing gml:id="r">
<gml:posList srsDimension="3">0 0 0 4 0 0 4 0 3 0 0 3 0 0 0</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon>
</gml:surfaceMember></gml:MultiSurface></lod3MultiSurface><con:fillingSurface><con:WindowSurface><lod3MultiSurface>
<gml:MultiSurface><gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing>
<gml:posList>1 0 1 2 0 1 2 0 2 1 0 2 1 0 1</gml:posList></gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember>
</gml:MultiSurface></lod3MultiSurface></con:WindowSurface></con:fillingSurface></con:WallSurface></boundary>
<bldg:buildingRoom><bldg:BuildingRoom><boundary><con:FloorSurface><lod3MultiSurface><gml:MultiSurface>
<gml:surfaceMember><gml:Polygon><gml:exterior><gml:LinearRing><gml:posList>0 0 0 4 0 0 4 3 0 0 3 0 0 0 0</gml:posList>
</gml:LinearRing></gml:exterior></gml:Polygon></gml:surfaceMember></gml:MultiSurface></lod3MultiSurface></con:FloorSurface>
</boundary></bldg:BuildingRoom></bldg:buildingRoom></bldg:Building></cityObjectMember></CityModel>
