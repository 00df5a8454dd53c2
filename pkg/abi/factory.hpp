#pragma once
// YADE's class factory, and the class of `O` in Python.

#include <list>

#include "abi/scene.hpp"

template <class T>
class Singleton {
 protected:
  static T* self;

 public:
  static T& instance();  // YADE's library contains the two instantiations used
};

namespace yade {

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

  shared_ptr<Factorable> createShared(string name);
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
  bool isInheritingFrom_recursive(const string& className, const string& baseClassName);
};

}  // namespace yade
