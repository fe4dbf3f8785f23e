// HttpLibrary: libmicrohttpd, loaded when a page is to be served. A program that serves none needs
// the C library alone, and does not lock what this library brings with it (TLS) in memory.
#pragma once

#include <microhttpd.h>

#include "kernel/core/load_error.hpp"

namespace tactus {

struct HttpLibrary {
  decltype(&MHD_start_daemon) start_daemon = nullptr;
  decltype(&MHD_stop_daemon) stop_daemon = nullptr;
  decltype(&MHD_run_wait) run_wait = nullptr;
  decltype(&MHD_get_connection_values) for_each_header = nullptr;
  decltype(&MHD_lookup_connection_value) value = nullptr;
  decltype(&MHD_get_connection_info) info = nullptr;
  decltype(&MHD_create_response_from_buffer) response_from_buffer = nullptr;
  decltype(&MHD_create_response_from_callback) response_from_callback = nullptr;
  decltype(&MHD_add_response_header) add_header = nullptr;
  decltype(&MHD_queue_response) queue_response = nullptr;
  decltype(&MHD_destroy_response) destroy_response = nullptr;
  decltype(&MHD_suspend_connection) suspend = nullptr;
  decltype(&MHD_resume_connection) resume = nullptr;

  /// False: `why` says which package is missing. [init]
  bool load(Message& why);
};

}  // namespace tactus
