// Metal has its vectors from here too; the library uses those of metal_stdlib.
#pragma once
