// print_openapi: the OpenAPI document of the server, on standard output.
#include <iostream>

#include "app/server/api.h"

int main() {
  std::cout << signweave::server::Api::openapi();
}
