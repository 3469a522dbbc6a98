#pragma once

#include "gpu/check.h"
#include "gpu/vulkan.h"

#include <string_view>
#include <utility>

namespace relamp::gpu
{

template<class Handle, class Info, class Parent>
using Create = VkResult(VKAPI_PTR*)(Parent, const Info*, const VkAllocationCallbacks*, Handle*);
template<class Handle, class Parent>
using Destroy = void(VKAPI_PTR*)(Parent, Handle, const VkAllocationCallbacks*);

/// A Vulkan object, destroyed with this and before its parent.
template<class Handle, class Parent = VkDevice>
class Owned
{
public:
    Owned() = default;
    Owned(Parent parent, Handle handle, Destroy<Handle, Parent> destroy)
        : parent_(parent), handle_(handle), destroy_(destroy)
    {}
    ~Owned()
    {
        if (handle_ != VK_NULL_HANDLE) destroy_(parent_, handle_, nullptr);
    }
    Owned(Owned&& other) noexcept
        : parent_(other.parent_), handle_(std::exchange(other.handle_, VK_NULL_HANDLE)),
          destroy_(other.destroy_)
    {}
    Owned& operator=(Owned&& other) noexcept
    {
        Owned former(std::move(*this));
        parent_ = other.parent_;
        handle_ = std::exchange(other.handle_, VK_NULL_HANDLE);
        destroy_ = other.destroy_;
        return *this;
    }

    [[nodiscard]] Handle get() const { return handle_; }
    [[nodiscard]] explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

private:
    Parent parent_ = VK_NULL_HANDLE;
    Handle handle_ = VK_NULL_HANDLE;
    Destroy<Handle, Parent> destroy_ = nullptr;
};

/// What Vulkan's `create` makes of `info`. Throws Error(device), saying `what` was tried.
template<class Handle, class Info, class Parent>
Owned<Handle, Parent> owned(Parent parent, Create<Handle, Info, Parent> create,
                            Destroy<Handle, Parent> destroy, const Info& info,
                            std::string_view what)
{
    Handle made = VK_NULL_HANDLE;
    check(create(parent, &info, nullptr, &made), what);
    return {parent, made, destroy};
}

} // namespace relamp::gpu
