#pragma once
// The scene with its parts, YADE's class factory, and the class of `O` in Python.

#include <list>

#include "yade/engine.hpp"
#include "yade/interaction.hpp"

template <class T>
class Singleton {
 protected:
  static T* self;

 public:
  static T& instance();  // YADE's library contains the two instantiations used
};

namespace yade {

// The periodic cell.
class Cell : public Serializable {
  Matrix3r _invTrsf;
  Matrix3r _trsfInc;
  Matrix3r _vGradTimesPrevH;
  Vector3r _size;
  Vector3r _cos;
  Vector3r _refSize;
  bool _hasShear;
  Matrix3r _shearTrsf;
  Matrix3r _unshearTrsf;
  double _glShearTrsfMatrix[16];

 public:
  Matrix3r trsf;
  Matrix3r refHSize;
  Matrix3r hSize;
  Matrix3r prevHSize;
  Matrix3r velGrad;
  Matrix3r nextVelGrad;
  Matrix3r prevVelGrad;
  int homoDeform;
  bool velGradChanged;
  bool flipFlippable;

  Cell();
  ~Cell() override;

  const Vector3r& getSize() const { return _size; }
  bool hasShear() const { return _hasShear; }
  const Matrix3r& getShearTrsf() const { return _shearTrsf; }
  const Matrix3r& getUnshearTrsf() const { return _unshearTrsf; }
  Vector3r unshearPt(const Vector3r& pt) const { return _unshearTrsf * pt; }
  Vector3r intrShiftPos(const Vector3i& cellDist) const { return hSize * cellDist.cast<Real>(); }

 private:
  friend struct LayoutProbe;
};

// Forces and torques per body and thread: a member of Scene.
class ForceContainer {
  vector<vector<Vector3r>> _forceData;
  vector<vector<Vector3r>> _torqueData;
  alignas(8) unsigned char hidden_[256];

 public:
  ForceContainer() = delete;
  ForceContainer(const ForceContainer&) = delete;
  ~ForceContainer();
  void addMaxId(int id);
  void addForce(int id, const Vector3r& force);
  void addTorque(int id, const Vector3r& torque);
  // Sums the contributions of the threads; must be called before reading.
  void sync();
  const Vector3r& getForce(int id);
  const Vector3r& getTorque(int id);

 private:
  friend struct LayoutProbe;
};

// The energy table of O.energy.
class EnergyTracker : public Serializable {
  alignas(8) unsigned char energies_[64];

 public:
  std::map<string, int> names;
  vector<bool> resetStep;
  EnergyTracker() = delete;
  ~EnergyTracker() override;
  Real getItem_py(const string& name);
  void setItem_py(const string& name, Real value);
};

class Scene : public Serializable {
  const unsigned int hostNameMax = 255;

 public:
  static const int nSpeedIter = 10;

  ForceContainer forces;
  Eigen::Matrix<Real, nSpeedIter, 1> SpeedElements;

 private:
  alignas(8) unsigned char rendererAndClock_[24];  // shared_ptr<OpenGLRenderer>, prevTime

 public:
  Real dt;
  long iter;
  bool subStepping;
  int subStep;
  Real time;
  Real speed;
  long stopAtIter;
  Real stopAtTime;
  bool isPeriodic;
  bool trackEnergy;
  bool doSort;
  bool runInternalConsistencyChecks;
  Body::id_t selectedBody;
  int subdomain;
  shared_ptr<Shape> subD;
  vector<string> tags;
  vector<shared_ptr<Engine>> engines;
  vector<shared_ptr<Engine>> _nextEngines;
  shared_ptr<BodyContainer> bodies;
  shared_ptr<InteractionContainer> interactions;
  shared_ptr<EnergyTracker> energy;
  vector<shared_ptr<Material>> materials;
  shared_ptr<Bound> bound;
  shared_ptr<Cell> cell;
  vector<shared_ptr<Serializable>> miscParams;

 private:
  alignas(8) unsigned char dispParams_[24];

 public:
  Scene() = delete;
  ~Scene() override;
  void moveToNextTimeStep();
};

// Draws the scene in YADE's 3D view; it exists only in a yade with a window.
class OpenGLRenderer : public Serializable {
 public:
  OpenGLRenderer() = delete;
  ~OpenGLRenderer() override;
  // Creates a functor of every class that draws.
  void init();
};

class ClassFactory : public Singleton<ClassFactory> {
  alignas(8) unsigned char libraryManagerAndMap_[136];

 protected:
  virtual ~ClassFactory();

 public:
  std::list<string> pluginClasses;

  ClassFactory() = delete;
  ClassFactory(const ClassFactory&) = delete;
  virtual string getClassName() const;
  virtual string getBaseClassName(int i) const;

  bool registerFactorable(string name, Factorable* (*create)(),
                          shared_ptr<Factorable> (*createShared)(), void* (*createPureCustom)());
  void registerPluginClasses(const char* fileAndClasses[]);
};

class Omega : public Singleton<Omega> {
 public:
  Omega() = delete;
  Omega(const Omega&) = delete;
  void loadPlugins(vector<string> pluginFiles);
  const shared_ptr<Scene>& getScene() const;
  void createSimulationLoop();
  bool isRunning();
  void pause();
};

}  // namespace yade
