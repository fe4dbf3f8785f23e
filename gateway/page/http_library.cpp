#include "gateway/page/http_library.hpp"

#include <dlfcn.h>

namespace tactus {
namespace {

template <class Function>
bool find(void* library, const char* name, Function& to) {
  to = reinterpret_cast<Function>(dlsym(library, name));
  return to != nullptr;
}

}  // namespace

bool HttpLibrary::load(Message& why) {
  void* const library = dlopen("libmicrohttpd.so.12", RTLD_NOW | RTLD_LOCAL);
  const bool good = library != nullptr && find(library, "MHD_start_daemon", start_daemon) &&
                    find(library, "MHD_stop_daemon", stop_daemon) &&
                    find(library, "MHD_run_wait", run_wait) &&
                    find(library, "MHD_get_connection_values", for_each_header) &&
                    find(library, "MHD_lookup_connection_value", value) &&
                    find(library, "MHD_get_connection_info", info) &&
                    find(library, "MHD_create_response_from_buffer", response_from_buffer) &&
                    find(library, "MHD_create_response_from_callback", response_from_callback) &&
                    find(library, "MHD_add_response_header", add_header) &&
                    find(library, "MHD_queue_response", queue_response) &&
                    find(library, "MHD_destroy_response", destroy_response) &&
                    find(library, "MHD_suspend_connection", suspend) &&
                    find(library, "MHD_resume_connection", resume);
  if (!good)
    why << "libmicrohttpd.so.12 of at least version 0.9.72 is missing; install libmicrohttpd12";
  return good;
}

}  // namespace tactus
