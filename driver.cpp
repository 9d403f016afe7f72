// driver: MODE mesh; includes bench source for meshes
#define main benchMain
#include "tests/bench/ambient_bench.cpp"
#undef main
#include <cstdio>
using namespace penumbra;
static Scene meshOf(const std::string& n){
  if(n=="knot") return loadGltf(std::filesystem::path("/work/main")/"assets"/"knot.glb");
  if(n=="terrain") return terrain(187);
  return objFile("/usr/share/glmark2/models/bunny.obj");
}
static std::vector<double> truthOf(const std::string& n,const Scene& s,const RayBundle& b,std::vector<std::size_t>& v){
  std::mt19937 random(3); for(int i=0;i<2500;++i) v.push_back(random()%s.positions.size());
  std::vector<double> t(2500);
  std::string f="/tmp/bake/truth_"+n+".bin";
  if(FILE* p=fopen(f.c_str(),"rb")){ fread(t.data(),8,t.size(),p); fclose(p); return t;}
  const BakePoints points = vertexPoints(s);
  parallelRows(2500,[&](int i){ const PointFan fan(s,points,points.points[points.pointOf[v[i]]],largestCoordinate(s.bounds)); std::int64_t tr=0;
   t[i]=tracePoint(b,fan,{8192,Weighting::cosine,{}},77,tr).mean(8192).visibility;});
  FILE* p=fopen(f.c_str(),"wb"); fwrite(t.data(),8,t.size(),p); fclose(p); return t;
}
int main(int c,char** a){
  std::string n=a[1]; int runs=atoi(a[2]); 
  Scene s=meshOf(n); RayBundle b(s); std::vector<std::size_t> v; auto t=truthOf(n,s,b,v);
  for(int k=3;k<c;++k){ int count=atoi(a[k]); double best=1e9,cpu; double e=0; double rays=0;
   for(int r=0;r<runs;++r){ BakeSettings st; st.rays.count=count; st.seed=r+1; cpu=cpuTime(); AmbientBake bk=bakeVertices(s,b,st); best=std::min(best,cpuTime()-cpu);
    rays+=double(bk.work.rays)/v.size()*v.size()/s.positions.size()/runs;
    double q=0; for(size_t i=0;i<v.size();++i){double d=bk.values[v[i]].visibility-t[i]; q+=d*d;} e+=q/v.size()/runs; }
   printf("%s %d rays %.1f rmse %.5f time %.1f ms  eff(time*(rmse/.0065)^1.333) %.1f\n",n.c_str(),count,rays,std::sqrt(e),best,best*std::pow(std::sqrt(e)/.0065,1.3333)); fflush(stdout);}
}
