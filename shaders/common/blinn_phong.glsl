// Blinn-Phong (Blinn 1977), normalised so that the highlight gets narrower and brighter with the exponent and not brighter
// altogether: (s + 8) / (8 pi) is Hoffman's fit (SIGGRAPH course "Physically-Based Shading Models", 2010).

const float pi = 3.14159265358979;

// Reflected radiance for each unit of facing irradiance. n, l, v unit: normal, to the light, to the eye.
vec3 blinnPhong(vec3 n, vec3 l, vec3 v, vec3 diffuse, vec3 specular, float shininess) {
    vec3 h = normalize(l + v);
    float highlight = (shininess + 8.0) / (8.0 * pi) * pow(max(dot(n, h), 0.0), shininess);
    return (diffuse / pi + specular * highlight) * max(dot(n, l), 0.0);
}
