#include "signweave/low/low.h"
