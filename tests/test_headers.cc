// SPDX-FileCopyrightText: 2026 The bladecurve authors
// SPDX-License-Identifier: MIT
// Does nothing: the test programs use its precompiled headers.
int main() {}
