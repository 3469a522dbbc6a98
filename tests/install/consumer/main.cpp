#include <relamp/relamp.h>

#include <iostream>

int main(int, char** argv)
{
    std::cout << relamp::readScan(argv[1]).triangleCount() << '\n';
}
