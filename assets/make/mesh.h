// Triangle meshes while they are being built: double precision, welded by position, checked for holes.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace penumbra::assets {

using Vec2 = glm::dvec2;
using Vec3 = glm::dvec3;
using Mat4 = glm::dmat4;

/// Triangles over shared positions (metres), counter-clockwise seen from outside.
struct Mesh {
    std::vector<Vec3> positions;
    std::vector<glm::uvec3> triangles;

    void triangle(const Vec3& a, const Vec3& b, const Vec3& c);
    void quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d);
    /// Adds a copy of `other`. The transform must not mirror: that would turn the mesh inside out.
    Mesh& append(const Mesh& other, const Mat4& fromOther = Mat4(1.0));
};

Mesh transformed(const Mesh& mesh, const Mat4& transform);

/// Rounds positions to 1e-6 m, so that the last bit of some machine's sin() cannot reach the file; then makes
/// equal positions one and drops triangles that have become degenerate (poles of a lathe, say).
Mesh welded(const Mesh& mesh);

/// Cuts triangles of `mesh` where a vertex of `neighbour` lies within one of their edges; both welded. The
/// surface stays as it is, and two pieces that touch along a line end there in the same vertices. Where they
/// do not, each rounds the line for itself, and here and there a pixel belongs to neither: one sees what is
/// behind the ground.
Mesh sharingVertices(const Mesh& mesh, const Mesh& neighbour);

/// True if every edge of a welded mesh is shared by exactly two triangles that run through it in opposite
/// directions.
bool isClosed(const Mesh& mesh);

/// Volume by the divergence theorem: positive if a closed mesh is the right way out.
double signedVolume(const Mesh& mesh);

/// What goes into the file. `normals` is empty for flat shading (glTF then asks the loader for flat normals).
struct VertexData {
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<std::uint32_t> indices;
};

/// Flat shading: the welded mesh itself.
VertexData flatVertices(const Mesh& welded);
/// Smooth shading across edges that bend by less than `creaseDegrees`, sharp across the others. Normals are
/// weighted by area and rounded to 1e-5.
VertexData smoothVertices(const Mesh& welded, double creaseDegrees);

/// Rounds to a multiple of 1/`perUnit`, never giving -0 (whose bytes would differ from 0).
double rounded(double value, double perUnit);

Mat4 translation(const Vec3& offset);
Mat4 rotation(double degrees, const Vec3& axis);
Mat4 scaling(const Vec3& factors);

}  // namespace penumbra::assets
