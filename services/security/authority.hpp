// SPDX-License-Identifier: Apache-2.0
// Keys, certificates and signatures, made by OpenSSL: EC P-256 and SHA-256. All functions throw
// std::runtime_error with OpenSSL's reason if it refuses.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "services/common/pem.hpp"
#include "services/security/permissions.hpp"

namespace foretrack::security {

/// Who signs: its certificate signs itself.
struct Authority {
  Key key;
  Certificate certificate;
};

Key new_key();
Authority new_authority(const std::string& name, const std::string& owner,
                        const Validity& validity);
/// For the key's holder, whose name becomes CN=name.
Certificate new_certificate(const Authority& authority, const std::string& name, EVP_PKEY& key,
                            const Validity& validity);
/// S/MIME, the text in the clear and the signature behind it.
std::string signed_document(const Authority& authority, const std::string& text);
/// Of all these certificates, and of those on the former list (null: there is none). Holds as long
/// as the authority: a peer with a list that is over would refuse everybody.
RevocationList new_revocations(const Authority& authority, const RevocationList& former,
                               const std::vector<Certificate>& revoked);

std::string pem_of(const X509& certificate);
std::string pem_of(const EVP_PKEY& key);
std::string pem_of(const X509_CRL& list);

}  // namespace foretrack::security
