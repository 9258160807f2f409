export function flatIdl(type: string): string;
