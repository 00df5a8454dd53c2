#pragma once
// publish<A, B>(file) registers classes derived from Published with YADE's factory, with Python (in
// yade.wrapper) and with the archives of O.save and O.load. Include it only where the classes are
// published: archive code is generated where it is included.

#include <algorithm>
#include <array>
#include <concepts>
#include <string_view>

// Archives before export.hpp, which makes code for those it has seen.
#include "yade/archives.hpp"
// clang-format off
#include <boost/serialization/export.hpp>
#include <boost/serialization/vector.hpp>
// clang-format on
#include "yade/published.hpp"

namespace yadefrag {

template <class T>
concept PublishedClass = std::derived_from<T, yade::Serializable> && requires {
  std::string_view(T::kName);
};

// "yade::" and the name: the class name in archives, as for YADE's own classes.
template <class T>
struct ArchiveName {
  static constexpr std::string_view kPrefix = "yade::";
  static constexpr std::string_view kName = T::kName;
  static constexpr auto kText = [] {
    std::array<char, kPrefix.size() + kName.size() + 1> text{};
    std::ranges::copy(kName, std::ranges::copy(kPrefix, text.begin()).out);
    return text;
  }();
};

}  // namespace yadefrag

// The expansion of BOOST_CLASS_EXPORT, for each class.
namespace boost::serialization {

template <yadefrag::PublishedClass T>
struct guid_defined<T> : boost::mpl::true_ {};

namespace ext {
template <yadefrag::PublishedClass T>
struct guid_impl<T> {
  static const char* call() { return yadefrag::ArchiveName<T>::kText.data(); }
};
}  // namespace ext

}  // namespace boost::serialization

namespace yadefrag {

// YADE publishes every class in its list again; this hides its own classes from the list
// temporarily.
class OnlyNewClasses {
 public:
  explicit OnlyNewClasses(std::list<std::string>& classes) : classes_(classes) {
    known_.swap(classes_);
  }
  OnlyNewClasses(const OnlyNewClasses&) = delete;
  OnlyNewClasses& operator=(const OnlyNewClasses&) = delete;
  ~OnlyNewClasses() { classes_.splice(classes_.end(), known_); }

 private:
  std::list<std::string>& classes_;
  std::list<std::string> known_;
};

template <class T>
void registerWithFactory() {
  using yade::Factorable;
  yade::ClassFactory::instance().registerFactorable(
      T::kName, [] { return static_cast<Factorable*>(new T); },
      [] { return boost::shared_ptr<Factorable>(new T); },
      [] { return static_cast<void*>(new T); });
  using Export = boost::archive::detail::extra_detail::guid_initializer<T>;
  boost::serialization::singleton<Export>::get_mutable_instance().export_guid();
}

template <PublishedClass... Classes>
void publish(const char* sourceFile) {
  (registerWithFactory<Classes>(), ...);
  auto& factory = yade::ClassFactory::instance();
  const OnlyNewClasses guard(factory.pluginClasses);
  const char* fileAndClasses[] = {sourceFile, Classes::kName..., nullptr};
  factory.registerPluginClasses(fileAndClasses);
  yade::Omega::instance().loadPlugins({});
}

}  // namespace yadefrag
