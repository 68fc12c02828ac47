// What OctoMap makes of clouds: reads them from standard input and writes every voxel that it knows.
//
// In, little-endian: f64 edge of a voxel; u32 number of clouds; a cloud is f32 x y z of its eye,
// u32 n and n points of f32 x y z. Out, a voxel: u16 key x y z and u16 1 for occupied, 0 for free.
#include <octomap/octomap.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>

template <class T>
static T in() {
  T value;
  if (fread(&value, sizeof value, 1, stdin) != 1) exit(2);
  return value;
}

static octomap::point3d point() {
  float x = in<float>(), y = in<float>(), z = in<float>();
  return octomap::point3d(x, y, z);
}

int main() {
  octomap::OcTree tree(in<double>());
  for (uint32_t clouds = in<uint32_t>(); clouds > 0; clouds--) {
    octomap::point3d eye = point();
    octomap::Pointcloud cloud;
    for (uint32_t n = in<uint32_t>(); n > 0; n--) cloud.push_back(point());
    tree.insertPointCloud(cloud, eye, -1, false, true);
  }
  tree.expand();
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    octomap::OcTreeKey key = leaf.getKey();
    uint16_t voxel[4] = {key[0], key[1], key[2], tree.isNodeOccupied(*leaf)};
    fwrite(voxel, sizeof voxel, 1, stdout);
  }
}
