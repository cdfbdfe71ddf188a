// The headers in C++
#include <caddon_flags.h>
#include <contact.h>
#include <contact_addon.h>

int main() {
  const int element = 1, module = 3, length = 1;
  int version = 0, error = 0;
  cntc_initialize(&element, &module, &version, &error, " ", &length);
  cntc_finalizelast();
  return error != 0 || version < 2500 || CNTC_if_units != 1933 || contact_last_error(0, -1, nullptr, 0) != 0;
}
