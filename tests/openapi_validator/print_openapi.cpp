// print_openapi: prints the OpenAPI document of the server to standard output.
#include <iostream>

#include "app/server/api.h"

int main() {
  std::cout << signweave::server::Api::openapi();
}
